#include "smoothers/sliding.hpp"

#include "smoothers/laplacian.hpp"
#include "smoothers/node_step.hpp"
#include "smoothers/worst_first.hpp"

namespace hexmend {
namespace {

// How far a node is led to see where that is, in mean edge lengths of its patch.
constexpr double PROBE_LENGTH = 1e-5;
// How many quads a thread looks at in one go.
constexpr std::int64_t QUADS_PER_CHUNK = 4096;

// One node on its patch, as a function of where it is on the surface.
class SlidingNode {
  public:
    SlidingNode(NodePatch<Lanes> &patch, const SlidingSurface &surface, Points points, Node node, double scale,
                const Tangents &along)
        : patch_(patch),
          points_(points),
          surface_(surface),
          node_(node),
          from_(points[node]),
          scale_(scale),
          t_{along[0], along[1], along[2]},
          u_{along[3], along[4], along[5]},
          curve_(dot(u_, u_) == 0) {}

    // T'g
    V3<double> tangential(const V3<double> &g) const { return {dot(t_, g), dot(u_, g), 0.0}; }

    // T'HT; a direction that there is not has the curvature of the first, and no part in any solution.
    SymmetricMatrix tangential(const SymmetricMatrix &h) const {
        V3<double> t = product(h, t_), u = product(h, u_);
        double one = dot(t_, t), other = curve_ ? one : dot(u_, u);
        return {one, dot(u_, t), 0.0, other, 0.0, one};
    }

    // Where the node ends that is led alpha times so far along the surface.
    Point trial_point(const V3<double> &d, double alpha) const {
        V3<double> far = alpha / scale_ * (d.x * t_ + d.y * u_);
        return surface_.project(node_, {from_[0] + far.x, from_[1] + far.y, from_[2] + far.z});
    }

    // From where the node is to a place, in mean edge lengths of the patch.
    V3<double> displacement(const Point &place) const {
        return scale_ * V3<double>{place[0] - from_[0], place[1] - from_[1], place[2] - from_[2]};
    }

    // The slope along d once the node is put back: over an edge of the surface it goes elsewhere than along its
    // tangent.
    double slope(const V3<double> &d, const V3<double> &gradient) const {
        double size = std::sqrt(dot(d, d));
        return size > 0 ? dot(gradient, displacement(trial_point(d, PROBE_LENGTH / size))) * (size / PROBE_LENGTH)
                        : 0.0;
    }

    // Algorithm A.5 with every trial on the surface, none that turns a quad: the place that is accepted, or where the
    // node is.
    template <bool soft>
    Point line_search(const ValueAndGradient &at, const V3<double> &d, double slope, const LocalStep &how,
                      NodeMover &mover) const {
        double alpha = how.first;
        for (int cut = 0; cut <= how.cuts && !lost_in_rounding(alpha, slope, at.value); ++cut, alpha *= how.shrink) {
            Point place = trial_point(d, alpha);
            if (surface_.quads.inverted_by_move(points_, surface_.slots[node_], place)) continue;
            patch_.set_direction(displacement(place));
            double trial = patch_.template value_along<soft>(1, how.delta, how.power);
            double bound = at.value + how.c1 * alpha * slope;
            mover.on_trial(patch_.size(), alpha, trial, bound);
            if (trial < bound) return place;
        }
        return from_;
    }

  private:
    NodePatch<Lanes> &patch_;
    Points points_;
    const SlidingSurface &surface_;
    Node node_;
    Point from_;
    double scale_;
    V3<double> t_, u_;
    bool curve_;

    static V3<double> product(const SymmetricMatrix &h, const V3<double> &v) {
        return {h.xx * v.x + h.xy * v.y + h.xz * v.z, h.xy * v.x + h.yy * v.y + h.yz * v.z,
                h.xz * v.x + h.yz * v.y + h.zz * v.z};
    }
};

template <bool soft>
void slide(NodePatch<Lanes> &patch, std::span<Point> points, Hexes hexes, Star star, const LocalStep &how,
           const SlidingSurface &surface, std::span<const Tangents> tangents, NodeMover &mover) {
    double scale = patch.load(points, hexes, star);
    patch.tabulate<soft>(how.delta);
    ValueAndGradient at = patch.value_and_gradient<soft>(how.delta, how.power);
    if (scale == 0 || at.value == 0 || !(at.value < INF)) return;
    Node node = node_of(hexes, star);
    SlidingNode slider(patch, surface, points, node, scale, tangents[surface.slots[node]]);
    V3<double> gradient = slider.tangential(at.gradient);
    if (gradient.x == 0 && gradient.y == 0) return;
    V3<double> d{};
    double slope = 0;
    if (how.direction != STEEPEST_DESCENT) {
        SymmetricMatrix hessian = slider.tangential(patch.hessian());
        d = newton_direction(hessian, gradient, how.direction == MODIFIED_NEWTON ? eigenvalue_shift(hessian) : 0.0);
        slope = slider.slope(d, at.gradient);
    }
    if (!(slope < 0)) {  // no direction of descent
        d = steepest_descent(at.value, gradient, how.power.p);
        slope = slider.slope(d, at.gradient);
    }
    if (slope < 0) points[node] = slider.template line_search<soft>(at, d, slope, how, mover);
}

template <bool soft>
std::int64_t sweep_sliding(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices groups,
                           Indices nodes, const LocalStep &how, const SlidingSurface &surface,
                           std::span<const Tangents> tangents) {
    std::int64_t most = largest_star(start, nodes);
    std::atomic<std::int64_t> evaluations = 0;
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
        auto group = nodes.subspan(groups[g], groups[g + 1] - groups[g]);
        parallel_chunks(group.size(), NODES_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
            NodePatch<Lanes> patch[1]{NodePatch<Lanes>(most)};
            NodeMover mover{points};
            for (Node i : group.subspan(begin, end - begin)) {
                Star star = corners.subspan(start[i], start[i + 1] - start[i]);
                if (surface.slides(i)) slide<soft>(patch[0], points, hexes, star, how, surface, tangents, mover);
                else visit<soft>(patch, points, hexes, {star}, how, mover);
            }
            evaluations += mover.evaluations;
        });
    }
    return evaluations;
}

}  // namespace

std::int64_t sliding_local(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices groups,
                           Indices nodes, int direction, double delta, ObjectiveNorm power, double first, double shrink,
                           double c1, int cuts, std::span<const Tangents> tangents, Indices slots, Indices roots,
                           Points vertices, std::span<const Piece> pieces, std::span<const Box> boxes,
                           std::span<const TreeLink> links, Indices quads_start, Indices quads_at,
                           std::span<const Quad> quads, Points outward) {
    SlidingSurface surface{slots, roots, {vertices, pieces, boxes, links}, {quads_start, quads_at, quads, outward}};
    LocalStep how{direction, delta, power, first, shrink, c1, cuts};
    return (delta != 0 ? sweep_sliding<true> : sweep_sliding<false>)(points, hexes, start, corners, groups, nodes, how,
                                                                     surface, tangents);
}

void sliding_laplacian(std::span<Point> points, Indices ring_start, Indices ring, Indices nodes, Indices slots,
                       Indices roots, Points vertices, std::span<const Piece> pieces, std::span<const Box> boxes,
                       std::span<const TreeLink> links, Indices quads_start, Indices quads_at,
                       std::span<const Quad> quads, Points outward) {
    SlidingSurface surface{slots, roots, {vertices, pieces, boxes, links}, {quads_start, quads_at, quads, outward}};
    in_place_on(&surface, points, ring_start, ring, nodes);
}

std::int64_t sliding_guarded(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices ring_start,
                             Indices ring, Indices nodes, bool keep_least_quality, Indices slots, Indices roots,
                             Points vertices, std::span<const Piece> pieces, std::span<const Box> boxes,
                             std::span<const TreeLink> links, Indices quads_start, Indices quads_at,
                             std::span<const Quad> quads, Points outward) {
    SlidingSurface surface{slots, roots, {vertices, pieces, boxes, links}, {quads_start, quads_at, quads, outward}};
    return guarded_on(&surface, points, hexes, start, corners, ring_start, ring, nodes, keep_least_quality);
}

std::int64_t sliding_worst_first(std::span<Point> points, Hexes hexes, Indices start, Indices corners,
                                 std::span<const bool> free, Indices candidates, std::span<double> q,
                                 std::span<bool> sound, double s, double rho, double penalty, double setback,
                                 Indices slots, Indices roots, Points vertices, std::span<const Piece> pieces,
                                 std::span<const Box> boxes, std::span<const TreeLink> links, Indices quads_start,
                                 Indices quads_at, std::span<const Quad> quads, Points outward) {
    SlidingSurface surface{slots, roots, {vertices, pieces, boxes, links}, {quads_start, quads_at, quads, outward}};
    return sweep_on(&surface, points, hexes, start, corners, free, candidates, q, sound, s, rho, penalty, setback);
}

void turned(Points before, Points after, std::span<const Quad> quads, Points outward, std::span<bool> is) {
    parallel_chunks(quads.size(), QUADS_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t f = begin; f < end; ++f) {
            is[f] = !is_inverted(points_of(before, quads[f]), outward[f]) &&
                    is_inverted(points_of(after, quads[f]), outward[f]);
        }
    });
}

}  // namespace hexmend
