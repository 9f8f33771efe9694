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

// Lanes of hexes without inverted corner.
inline MaskOf<Lanes> valid_lanes(const Corners<Lanes> &x) {
    MaskOf<Lanes> valid = broadcast<Lanes>(0.0) == 0.0;
    unroll<8>([&](auto t) { valid = valid & (determinant(x.template edges<t>()) > 0.0); });
    return valid;
}

// Corner coordinates of `count` hexes at a node from number `first` of its star on.
inline Corners<Lanes> gather_star(Points points, Hexes hexes, Star star, std::size_t first, int count) {
    const Hex *hex[LANES];
    for (int i = 0; i < LANES; ++i) hex[i] = &hexes[star[first + (i < count ? i : count - 1)] / 8];
    Corners<Lanes> x;
    for (int c = 0; c < 8; ++c)
        x.at[c] = load_lanes<Lanes>([&](int i) -> const Point & { return points[(*hex[i])[c]]; });
    return x;
}

// Guard of smart Laplacian smoothing that rejects moves which invert a valid hex.
class InversionGuard {
  public:
    InversionGuard(Points points, const HexMesh &mesh)
        : points_(points), mesh_(mesh), valid_(mesh.hexes.size()), after_(mesh.largest_star()) {
        for_each_block<Lanes>(valid_.size(), [&](std::int64_t first, int count) {
            const auto valid = valid_lanes(gather_corners<Lanes>(points_, mesh_.hexes, first, count));
            for (int i = 0; i < count; ++i) valid_[first + i] = valid[i] & 1;
        });
    }

    // True if the present position of a node does harm, unlike that which the guard accepted last.
    bool rejects(Star attached) {
        // Local copies: bytes may be parts of anything, so that the members would be loaded again after each store.
        const Points points = points_;
        const Hexes hexes = mesh_.hexes;
        std::uint8_t *const valid = valid_.data(), *const after = after_.data();
        for (std::size_t first = 0; first < attached.size(); first += LANES) {
            const int count = static_cast<int>(std::min<std::size_t>(LANES, attached.size() - first));
            const auto now = valid_lanes(gather_star(points, hexes, attached, first, count));
            int harm = 0;
            for (int i = 0; i < count; ++i) {
                after[first + i] = now[i] & 1;
                harm |= valid[attached[first + i] / 8] & ~now[i];
            }
            if (harm) return true;
        }
        for (std::size_t s = 0; s < attached.size(); ++s) valid[attached[s] / 8] = after[s];
        return false;
    }

  private:
    Points points_;
    const HexMesh &mesh_;
    std::vector<std::uint8_t> valid_, after_;
};

// Quality of a hex. Not inlined, so that an unmoved hex gets the same bits from each call.
__attribute__((noinline)) Quality<double> quality_of(Points points, const Hex &hex) {
    return SingleHex(points, hex).quality();
}

// Guard that also rejects moves which lower the least q(H) of the hexes at the node.
class QualityGuard {
  public:
    QualityGuard(Points points, const HexMesh &mesh)
        : points_(points), mesh_(mesh), now_(mesh.hexes.size()), after_(mesh.largest_star()) {
        parallel_for(now_.size(), HEXES_PER_CHUNK,
                     [&](std::int64_t h) { now_[h] = quality_of(points_, mesh_.hexes[h]); });
    }

    bool rejects(Star attached) {
        double least = INF;
        for (auto corner : attached) least = std::min(least, now_[corner / 8].q);
        for (std::size_t s = 0; s < attached.size(); ++s) {
            const int h = attached[s] / 8;
            after_[s] = quality_of(points_, mesh_.hexes[h]);
            if ((now_[h].valid && !after_[s].valid) || after_[s].q < least) return true;
        }
        for (std::size_t s = 0; s < attached.size(); ++s) now_[attached[s] / 8] = after_[s];
        return false;
    }

  private:
    Points points_;
    const HexMesh &mesh_;
    std::vector<Quality<double>> now_, after_;
};

template <class Guard>
std::int64_t smart_sweep_of(std::span<Point> points, const HexMesh &mesh, Indices ring_start, Indices ring,
                            Indices nodes, const SlidingSurface *surface) {
    Guard guard(points, mesh);
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
    return (keep_least_quality ? smart_sweep_of<QualityGuard>
                               : smart_sweep_of<InversionGuard>)(points, mesh, ring_start, ring, nodes, surface);
}

}  // namespace hexmend
