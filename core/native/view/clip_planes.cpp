#include "view/clip_planes.hpp"

#include <algorithm>

#include "view/plane.hpp"

namespace hexmend {

void centres_kept(Points points, Hexes hexes, Points normals, Numbers offsets, bool notch, std::span<bool> kept) {
    std::fill(kept.begin(), kept.end(), !notch);
    std::vector<double> heights(points.size());
    for (std::size_t p = 0; p < normals.size(); ++p) {
        for (std::size_t i = 0; i < points.size(); ++i) heights[i] = height(points[i], normals[p]);
        for (std::size_t h = 0; h < hexes.size(); ++h) {
            if (kept[h] == notch) continue;  // already decided
            double sum = 0;
            for (Node node : hexes[h]) sum += heights[node];
            kept[h] = sum <= 8 * offsets[p];
        }
    }
}

void touched(Points points, Hexes hexes, Points normals, Numbers offsets, bool notch, std::span<bool> answer) {
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
