#include "smoothers/sliding.hpp"

#include "energy/node_quads.hpp"
#include "smoothers/node_step.hpp"

namespace hexmend {
namespace {

// Length of the probing step that measures a slope along the surface, in mean edge lengths of the patch.
constexpr double PROBE_LENGTH = 1e-5;
// Quads that one thread takes at a time.
constexpr std::int64_t QUADS_PER_CHUNK = 4096;

// Arguments of a sweep that are the same for all its nodes.
struct SlidingSweep {
    Hexes hexes;
    const NodeStepSettings &settings;
    const SlidingSurface &surface;
    std::span<const Tangents> tangents;
};

// A node and its patch as a function of the node's position on the surface. Vectors (d.x, d.y, 0) are coordinates along
// the node's two tangents; lengths are in mean edge lengths of the patch.
class SlidingNode {
  public:
    SlidingNode(const SlidingSurface &surface, Points points, Node node, double scale, const Tangents &tangents)
        : points_(points),
          surface_(surface),
          node_(node),
          from_(points[node]),
          scale_(scale),
          t_{tangents[0], tangents[1], tangents[2]},
          u_{tangents[3], tangents[4], tangents[5]},
          on_curve_(dot(u_, u_) == 0) {}

    // T'g
    V3<double> tangential(const V3<double> &g) const { return {dot(t_, g), dot(u_, g), 0.0}; }

    // T'HT. A coordinate without a tangent gets the curvature along t and is decoupled, so that no solution uses it.
    SymmetricMatrix tangential(const SymmetricMatrix &h) const {
        V3<double> t = h * t_, u = h * u_;
        double one = dot(t_, t), other = on_curve_ ? one : dot(u_, u);
        return {one, dot(u_, t), 0.0, other, 0.0, one};
    }

    // The point of the surface closest to the end of the tangential step alpha d.
    Point trial_point(const V3<double> &d, double alpha) const {
        V3<double> step = alpha / scale_ * (d.x * t_ + d.y * u_);
        return surface_.project(node_, {from_[0] + step.x, from_[1] + step.y, from_[2] + step.z});
    }

    // Displacement from the node to a point.
    V3<double> displacement(const Point &place) const { return scale_ * (vector(place) - vector(from_)); }

    // Derivative along d after projection. It differs from the tangential derivative where the surface has an edge.
    double slope(const V3<double> &d, const V3<double> &gradient) const {
        double size = std::sqrt(dot(d, d));
        return size > 0 ? dot(gradient, displacement(trial_point(d, PROBE_LENGTH / size))) * (size / PROBE_LENGTH)
                        : 0.0;
    }

    bool flips_quad(const Point &place) const {
        return surface_.quads.flipped_by_move(points_, surface_.slots[node_], place);
    }

  private:
    Points points_;
    const SlidingSurface &surface_;
    Node node_;
    Point from_;
    double scale_;
    V3<double> t_, u_;
    bool on_curve_;
};

// The boundary quads of a sweep in which they do not count.
struct NoQuads {};

// Take a step at a node that slides: Algorithms A.2 to A.5 in the tangent space, every trial projected onto the
// surface. A trial that flips a boundary quad is rejected. `quads` are those of the node that count.
template <bool soft, class Patch, class Quads>
void slide(Patch &patch, Quads &quads, const SurfaceTerm *term, std::span<Point> points, Star star,
           const SlidingSweep &sweep, NodeMover &mover) {
    constexpr bool with_quads = !std::is_same_v<Quads, NoQuads>;
    const NodeStepSettings &settings = sweep.settings;
    const SlidingSurface &surface = sweep.surface;
    double scale = patch.load(points, sweep.hexes, star);
    patch.template tabulate<soft>(settings.delta);
    ValueAndGradient at = patch.template value_and_gradient<soft>(settings.delta, settings.norm);
    if (scale == 0) return;
    Node i = node_of(sweep.hexes, star);
    if constexpr (with_quads) {
        quads.load(points, surface.quads, surface.slots[i], *term, scale);
        quads.add_to(at, settings.norm);
    }
    if (at.value == 0 || !(at.value < INF)) return;
    SlidingNode node(surface, points, i, scale, sweep.tangents[surface.slots[i]]);
    V3<double> gradient = node.tangential(at.gradient);
    if (gradient.x == 0 && gradient.y == 0) return;
    SearchDirection chosen = choose_direction(
        at.value, gradient, settings,
        [&] {
            SymmetricMatrix hessian = patch.hessian();
            if constexpr (with_quads) quads.add_to(hessian, settings.norm);
            return node.tangential(hessian);
        },
        [&](const V3<double> &d) { return node.slope(d, at.gradient); });
    if (!(chosen.slope < 0)) return;
    Point place;
    double alpha = settings.search(at.value, chosen.slope, [&](double alpha, double bound) {
        place = node.trial_point(chosen.d, alpha);
        if (node.flips_quad(place)) return INF;
        patch.set_direction(node.displacement(place));
        double value = patch.template value_along<soft>(1, settings.delta, settings.norm);
        if constexpr (with_quads) value += quads.value_at(node.displacement(place), settings.norm);
        mover.on_trial(patch.size(), alpha, value, bound);
        return value;
    });
    if (alpha > 0) points[i] = place;
}

template <bool soft, class Quads, class Target>
std::int64_t sliding_sweep_of(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                              const SlidingSweep &sweep, const SurfaceTerm *term, const Target &target) {
    std::int64_t most = largest_star(mesh, nodes);
    return sum_over_groups(groups, nodes, [&](Indices chunk) {
        NodePatch<Lanes, Target> patch[1]{{most, target}};
        [[maybe_unused]] Quads quads;
        NodeMover mover{points};
        for (Node i : chunk) {
            Star star = mesh.star(i);
            if (sweep.surface.slides(i)) slide<soft>(patch[0], quads, term, points, star, sweep, mover);
            else step_nodes<soft>(patch, points, mesh.hexes, {star}, sweep.settings, mover);
        }
        return mover.evaluations;
    });
}

}  // namespace

std::int64_t sliding_sweep(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                           const NodeStepSettings &settings, const SlidingSurface &surface,
                           std::span<const Tangents> tangents, const SurfaceTerm *term) {
    expect_sweep(points, mesh, groups, nodes, settings);
    expect_nodes(&surface, points.size());
    expect(tangents.size() == surface.count(), "tangents: two for each sliding node are expected");
    expect(!term || term->counted.size() == surface.quads.quads.size(), "term: a row for each quad is expected");
    SlidingSweep sweep{mesh.hexes, settings, surface, tangents};
    return with_cases(settings.target, settings.delta, [&](auto soft, const auto &target) {
        using Target = std::remove_cvref_t<decltype(target)>;
        auto run = term ? sliding_sweep_of<soft, NodeQuads, Target> : sliding_sweep_of<soft, NoQuads, Target>;
        return run(points, mesh, groups, nodes, sweep, term, target);
    });
}

void flipped_quads(Points before, Points after, std::span<const Quad> quads, Points outward, std::span<bool> flipped) {
    expect(before.size() == after.size(), "before and after have different lengths: expected a row a node");
    expect(have_rows(quads.size(), outward, flipped), "outward and flipped: a row for each of quads is expected");
    parallel_for(quads.size(), QUADS_PER_CHUNK, [&](std::int64_t f) {
        flipped[f] =
            !is_flipped(points_of(before, quads[f]), outward[f]) && is_flipped(points_of(after, quads[f]), outward[f]);
    });
}

}  // namespace hexmend
