#include "smoothers/laplacian.hpp"

#include "mesh/csr.hpp"
#include "mesh/quality.hpp"
#include "simd/simd_hexes.hpp"

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

// Guard of smart Laplacian smoothing: it rejects moves that invert a valid hex and, with `quality`, those that lower
// the least q(H) of the hexes at the node.
template <bool quality> class Guard {
  public:
    Guard(Points points, const HexMesh &mesh)
        : points_(points), mesh_(mesh), now_(mesh.hexes.size()), after_(mesh.largest_star()) {
        parallel_for(now_.size(), HEXES_PER_CHUNK, [&](std::int64_t h) { now_[h] = measured(h); });
    }

    // True if the present position of a node does harm, unlike that which the guard accepted last.
    bool rejects(Star attached) {
        double least = INF;
        for (auto corner : attached) least = std::min(least, now_[corner / 8].q);
        for (std::size_t s = 0; s < attached.size(); ++s) {
            const int h = attached[s] / 8;
            after_[s] = measured(h);
            if ((now_[h].valid && !after_[s].valid) || after_[s].q < least) return true;
        }
        for (std::size_t s = 0; s < attached.size(); ++s) now_[attached[s] / 8] = after_[s];
        return false;
    }

  private:
    Points points_;
    const HexMesh &mesh_;
    std::vector<Quality<double>> now_, after_;

    // Not inlined, so that an unmoved hex gets the same bits from each call.
    __attribute__((noinline)) Quality<double> measured(std::int64_t h) const {
        const Hex &cell = mesh_.hexes[h];
        return quality ? cell_quality(points_, cell) : Quality<double>{0, is_valid(points_, cell)};
    }
};

template <bool quality>
std::int64_t smart_sweep_of(std::span<Point> points, const HexMesh &mesh, Indices ring_start, Indices ring,
                            Indices nodes, const SlidingSurface *surface) {
    Guard<quality> guard(points, mesh);
    std::int64_t rejected = 0;
    for (Node i : nodes) {
        const Point before = points[i];
        points[i] = target(points, ring_start, ring, i, surface);
        if (guard.rejects(mesh.star(i))) points[i] = before, ++rejected;
    }
    return rejected;
}

}  // namespace

void in_place(std::span<Point> points, Indices ring_start, Indices ring, Indices nodes, const SlidingSurface *surface) {
    expect_rings(points.size(), ring_start, ring);
    expect_nodes(surface, points.size());
    for (Node i : nodes) points[i] = target(points, ring_start, ring, i, surface);
}

void simultaneous(Points points, Indices ring_start, Indices ring, Indices nodes, std::span<Point> moved) {
    expect_rings(points.size(), ring_start, ring);
    expect(moved.size() == points.size(), "moved: a row for each of points is expected");
    parallel_for(nodes.size(), ROWS_PER_CHUNK,
                 [&](std::int64_t k) { moved[nodes[k]] = ring_mean(points, ring_start, ring, nodes[k]); });
}

std::int64_t smart_sweep(std::span<Point> points, const HexMesh &mesh, Indices ring_start, Indices ring, Indices nodes,
                         bool keep_least_quality, const SlidingSurface *surface) {
    expect_points(mesh, points);
    expect_rings(points.size(), ring_start, ring);
    expect_nodes(surface, points.size());
    return (keep_least_quality ? smart_sweep_of<true> : smart_sweep_of<false>)(points, mesh, ring_start, ring, nodes,
                                                                               surface);
}

}  // namespace hexmend
