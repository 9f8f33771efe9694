#include "smoothers/laplacian.hpp"

#include "mesh/quality.hpp"

namespace hexmend {
namespace {

inline Point ring_mean(Points points, Indices ring_start, Indices ring, Node i) {
    Point sum{};
    for (auto s = ring_start[i]; s < ring_start[i + 1]; ++s)
        for (int k = 0; k < 3; ++k) sum[k] += points[ring[s]][k];
    double count = ring_start[i + 1] - ring_start[i];
    return {sum[0] / count, sum[1] / count, sum[2] / count};
}

// Target of node i: the mean, projected if the node slides.
inline Point target(Points points, Indices ring_start, Indices ring, Node i, const SlidingSurface *surface) {
    Point mean = ring_mean(points, ring_start, ring, i);
    return surface && surface->slides(i) ? surface->project_unless_flipping(points, i, mean) : mean;
}

// Quality of a hex, or only whether it is valid. Not inlined, so that an unmoved hex gets the same bits from each call.
template <bool by_quality> __attribute__((noinline)) Quality<double> evaluate_hex(Points points, const Hex &hex) {
    SingleHex x(points, hex);
    if constexpr (by_quality) return x.quality();
    else return {0.0, x.valid()};
}

template <bool by_quality>
std::int64_t smart_sweep_of(std::span<Point> points, const HexMesh &mesh, Indices ring_start, Indices ring,
                            Indices nodes, const SlidingSurface *surface) {
    const Hexes hexes = mesh.hexes;
    // Quality of the hexes at their present positions, where `known`: an accepted move has evaluated them.
    std::vector<Quality<double>> now(hexes.size()), after(mesh.largest_star());
    std::vector<std::uint8_t> known(hexes.size());
    std::int64_t rejected = 0;
    for (Node i : nodes) {
        Star attached = mesh.star(i);
        double least = INF;
        for (auto corner : attached) {
            int h = corner / 8;
            if (!known[h]) now[h] = evaluate_hex<by_quality>(points, hexes[h]), known[h] = true;
            least = std::min(least, now[h].q);
        }
        Point before = points[i];
        points[i] = target(points, ring_start, ring, i, surface);
        bool harm = false;
        for (std::size_t s = 0; s < attached.size() && !harm; ++s) {
            int h = attached[s] / 8;
            after[s] = evaluate_hex<by_quality>(points, hexes[h]);
            harm = (now[h].valid && !after[s].valid) || after[s].q < least;
        }
        if (harm) {
            points[i] = before;
            ++rejected;
        } else {
            for (std::size_t s = 0; s < attached.size(); ++s) now[attached[s] / 8] = after[s];
        }
    }
    return rejected;
}

}  // namespace

void in_place(std::span<Point> points, Indices ring_start, Indices ring, Indices nodes, const SlidingSurface *surface) {
    for (Node i : nodes) points[i] = target(points, ring_start, ring, i, surface);
}

void simultaneous(Points points, Indices ring_start, Indices ring, Indices nodes, std::span<Point> moved) {
    parallel_for(nodes.size(), ROWS_PER_CHUNK,
                 [&](std::int64_t k) { moved[nodes[k]] = ring_mean(points, ring_start, ring, nodes[k]); });
}

std::int64_t smart_sweep(std::span<Point> points, const HexMesh &mesh, Indices ring_start, Indices ring, Indices nodes,
                         bool keep_least_quality, const SlidingSurface *surface) {
    return (keep_least_quality ? smart_sweep_of<true> : smart_sweep_of<false>)(points, mesh, ring_start, ring, nodes,
                                                                               surface);
}

}  // namespace hexmend
