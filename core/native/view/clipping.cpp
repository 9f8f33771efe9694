#include <algorithm>
#include <utility>

#include "view/view.hpp"

namespace hexmend {
namespace {

// Clip a polygon at one plane: now to then.
void cut_off(const std::vector<Point> &now, const Point &normal, double offset, std::vector<Point> &then) {
    then.clear();
    const Point *last = &now.back();
    double below = height(*last, normal) - offset;
    for (const Point &corner : now) {
        double above = height(corner, normal) - offset;
        if ((above > 0) != (below > 0)) {
            double share = below / (below - above);
            Point &crossing = then.emplace_back();
            for (int k = 0; k < 3; ++k) crossing[k] = (*last)[k] + share * (corner[k] - (*last)[k]);
        }
        if (above <= 0) then.push_back(corner);
        last = &corner, below = above;
    }
}

}  // namespace

// Sutherland and Hodgman's clipping (Communications of the ACM 17, 1974).
std::tuple<OwnedArray<double, 3>, OwnedArray<std::int64_t>, OwnedArray<std::int64_t>> before(
    Points points, PointNumbers start, PointNumbers places, PointNumbers owner, Points normals, Numbers offsets) {
    expect(are_csr(start, places.size()), "start: its last number is expected to be the length of places");
    expect(start.size() == owner.size() + 1, "owner: one for each polygon is expected");
    expect(offsets.size() == normals.size(), "offsets: one for each of normals is expected");
    OwnedArray<double, 3> kept;
    OwnedArray<std::int64_t> begin{{0}}, whose;
    kept.values.reserve(3 * places.size());
    begin.values.reserve(owner.size() + 1), whose.values.reserve(owner.size());
    std::vector<Point> now, then;
    for (std::size_t i = 0; i < owner.size(); ++i) {
        now.clear();
        for (std::int64_t at = start[i]; at < start[i + 1]; ++at) now.push_back(points[places[at]]);
        for (std::size_t p = 0; p < normals.size() && now.size() >= 3; ++p) {
            cut_off(now, normals[p], offsets[p], then);
            std::swap(now, then);
        }
        if (now.size() < 3) continue;
        for (const Point &corner : now) kept.values.insert(kept.values.end(), corner.begin(), corner.end());
        begin.values.push_back(begin.values.back() + static_cast<std::int64_t>(now.size()));
        whose.values.push_back(owner[i]);
    }
    return {std::move(kept), std::move(begin), std::move(whose)};
}

double centre_heights(Points points, Hexes hexes, Points normal, std::span<double> eightfold) {
    expect(eightfold.size() == hexes.size(), "eightfold: a row for each of hexes is expected");
    expect(normal.size() == 1, "normal: one is expected");
    std::vector<double> heights(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) heights[i] = height(points[i], normal[0]);
    double furthest = 0;
    for (std::size_t h = 0; h < hexes.size(); ++h) {
        double sum = 0, low = INF, high = -INF;
        for (Node node : hexes[h]) {
            sum += heights[node];
            low = std::min(low, heights[node]), high = std::max(high, heights[node]);
        }
        eightfold[h] = sum;
        furthest = std::max(furthest, high - low);
    }
    return furthest;
}

std::pair<OwnedArray<Node, 4>, OwnedArray<Node>> opened(Hexes hexes, Neighbours neighbours, Numbers eightfold,
                                                        double extent, double offset) {
    expect(neighbours.size() == hexes.size() && eightfold.size() == hexes.size(),
           "hexes, neighbours and eightfold have different lengths: expected a row a hex");
    std::vector<Node> quads, owners;
    double most = 8 * offset, least = 8 * (offset - extent);  // the centre of a neighbour is an extent higher at most
    for (std::size_t h = 0; h < hexes.size(); ++h) {
        if (!(eightfold[h] <= most && eightfold[h] > least)) continue;
        for (int face = 0; face < 6; ++face) {
            Node behind = neighbours[h][face];
            if (behind < 0 || eightfold[behind] <= most) continue;
            for (int corner : FACES[face]) quads.push_back(hexes[h][corner]);
            owners.push_back(static_cast<Node>(h));
        }
    }
    return {{std::move(quads)}, {std::move(owners)}};
}

void touched(Points points, Hexes hexes, Points normals, Numbers offsets, bool notch, std::span<bool> answer) {
    expect(offsets.size() == normals.size(), "offsets: one for each of normals is expected");
    expect(answer.size() == hexes.size() * normals.size(), "answer: one for each of hexes and normals is expected");
    std::size_t planes = normals.size();
    std::vector<double> heights(points.size() * planes), slack(planes);
    for (std::size_t p = 0; p < planes; ++p) {
        double furthest = std::abs(offsets[p]);
        for (std::size_t i = 0; i < points.size(); ++i) {
            double &here = heights[i * planes + p] = height(points[i], normals[p]);
            furthest = std::max(furthest, std::abs(here));
        }
        slack[p] = 1e-12 * furthest;
    }
    std::fill(answer.begin(), answer.end(), false);
    for (std::size_t h = 0; h < hexes.size(); ++h)
        for (std::size_t p = 0; p < planes; ++p) {
            double low = INF, high = -INF;
            for (Node node : hexes[h]) {
                low = std::min(low, heights[node * planes + p]);
                high = std::max(high, heights[node * planes + p]);
            }
            bool before = high<offsets[p] - slack[p], beyond = low> offsets[p] + slack[p];
            answer[h * planes + p] = !(before || beyond);
            if (notch ? before : beyond) {  // no section shows this hex
                std::fill_n(&answer[h * planes], planes, false);
                break;
            }
        }
}

}  // namespace hexmend
