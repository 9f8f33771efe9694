
#include "view/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simd/threads.hpp"

namespace hexmend {
namespace {

using Vector = V3<double>;
using PixelPoint = std::array<float, 3>;  // x and y in pixels, height towards the light

// A corner is sampled at a point shifted by the fraction INSET towards its polygon's centre, since an adjacent wall
// would hide the corner itself, and by OFFSET_PIXELS along the normal: 0.71 pixels avoid self-shadowing at every angle,
// because the height of the shifted point above the surface grows with the surface's slope.
constexpr double INSET = 0.15, OFFSET_PIXELS = 1.0;

// Height map of a scene seen along a direction: the largest height in each pixel of a square.
class HeightMap {
  public:
    HeightMap(const Vector &direction, const Vector &middle, double radius, std::int64_t side)
        : side_(side),
          scale_((side - 4) / (2 * radius)),
          middle_(middle),
          w_(direction),
          heights_(side * side, -std::numeric_limits<float>::infinity()) {
        Vector aside = std::abs(w_.x) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
        u_ = cross(aside, w_);
        u_ = (1 / length(u_)) * u_;
        v_ = cross(w_, u_);
    }

    PixelPoint place(const Vector &p) const {
        Vector q = scale_ * (p - middle_);
        return {static_cast<float>(dot(q, u_) + 0.5 * side_), static_cast<float>(dot(q, v_) + 0.5 * side_),
                static_cast<float>(dot(q, w_))};
    }

    // Rasterise a triangle: every pixel whose centre lies in it.
    void draw(PixelPoint a, PixelPoint b, PixelPoint c) {
        float area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if (area == 0) return;
        // Height in the triangle: z = z_0 + x gx + y gy.
        float gx = ((b[2] - a[2]) * (c[1] - a[1]) - (c[2] - a[2]) * (b[1] - a[1])) / area;
        float gy = ((c[2] - a[2]) * (b[0] - a[0]) - (b[2] - a[2]) * (c[0] - a[0])) / area;
        if (b[1] < a[1]) std::swap(a, b);
        if (c[1] < b[1]) std::swap(b, c);
        if (b[1] < a[1]) std::swap(a, b);  // a is the lowest now, c the highest
        int low = first(a[1]), middle = first(b[1]), high = first(c[1]);
        if (low == high) return;
        float z0 = a[2] - a[0] * gx - a[1] * gy;
        float far = (c[0] - a[0]) / (c[1] - a[1]);
        float lower = (b[0] - a[0]) / (b[1] - a[1]), upper = (c[0] - b[0]) / (c[1] - b[1]);
        for (int row = low; row < high; ++row) {
            float y = row + 0.5f, one = a[0] + (y - a[1]) * far;
            float other = row < middle ? a[0] + (y - a[1]) * lower : b[0] + (y - b[1]) * upper;
            float *heights = &heights_[row * side_], z = z0 + y * gy;
            for (int at = first(std::min(one, other)), end = first(std::max(one, other)); at < end; ++at)
                heights[at] = std::max(heights[at], z + (at + 0.5f) * gx);
        }
    }

    // True if nothing lies between a point and the light.
    bool lit(const PixelPoint &at) const {
        auto x = static_cast<std::int64_t>(at[0]), y = static_cast<std::int64_t>(at[1]);
        return x < 0 || y < 0 || x >= side_ || y >= side_ || heights_[y * side_ + x] <= at[2];
    }

  private:
    // The first pixel in the map whose centre is beyond x.
    int first(float x) const { return std::clamp(static_cast<int>(std::ceil(x - 0.5f)), 0, static_cast<int>(side_)); }

    std::int64_t side_;
    double scale_;
    Vector middle_, u_, v_, w_;
    std::vector<float> heights_;
};

// Sample points of all corners.
std::vector<Vector> sample_points(Points points, PointNumbers start, PointNumbers places, Points normals,
                                  double before) {
    std::vector<Vector> answer(places.size());
    for (std::size_t i = 0; i + 1 < start.size(); ++i) {
        Vector centre{}, away = before * vector(normals[i]);
        for (std::int64_t at = start[i]; at < start[i + 1]; ++at) centre += vector(points[places[at]]);
        centre = (1.0 / (start[i + 1] - start[i])) * centre;
        for (std::int64_t at = start[i]; at < start[i + 1]; ++at) {
            Vector corner = vector(points[places[at]]);
            answer[at] = corner + INSET * (centre - corner) + away;
        }
    }
    return answer;
}

}  // namespace

void normals(Points points, PointNumbers start, PointNumbers places, std::span<Point> answer) {
    expect(are_csr(start, places.size()), "start: its last number is expected to be the length of places");
    expect(answer.size() + 1 == start.size(), "answer: a row for each polygon is expected");
    for (std::size_t i = 0; i + 1 < start.size(); ++i) {
        Vector first = vector(points[places[start[i]]]),
               sum{};  // relative to a corner: far from the origin absolute products are all rounding
        for (std::int64_t at = start[i] + 2; at < start[i + 1]; ++at)
            sum += cross(vector(points[places[at - 1]]) - first, vector(points[places[at]]) - first);
        double size = length(sum);
        if (size > 0) sum = (1 / size) * sum;
        answer[i] = point(sum);
    }
}

// Object-space ambient occlusion by a height map a direction, as HexaLab accumulates it (Bracci et al. 2019).
void shine(Points points, PointNumbers start, PointNumbers places, Points normals, Points directions, std::int64_t side,
           std::span<double> light, std::span<double> whole) {
    expect(are_csr(start, places.size()), "start: its last number is expected to be the length of places");
    expect(normals.size() + 1 == start.size(), "normals: a row for each polygon is expected");
    expect(have_rows(places.size(), light, whole), "light and whole: one for each of places is expected");
    expect(side > 4, "side: more than four pixels are expected");
    if (places.empty()) return;
    Point low = points[places[0]], high = low;
    for (std::int64_t place : places)
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], points[place][k]);
            high[k] = std::max(high[k], points[place][k]);
        }
    Vector middle = 0.5 * (vector(low) + vector(high));
    double radius = std::max(0.5 * length(vector(high) - vector(low)), 1e-300);
    std::vector<Vector> looked = sample_points(points, start, places, normals, OFFSET_PIXELS * 2 * radius / (side - 4));

    std::vector<std::vector<bool>> reached(directions.size());
    parallel(directions.size(), [&](std::int64_t d) {
        Vector direction = vector(directions[d]);
        HeightMap map(direction, middle, radius, side);
        std::vector<PixelPoint> flat(points.size());
        for (std::size_t p = 0; p < points.size(); ++p) flat[p] = map.place(vector(points[p]));
        std::vector<std::int64_t> facing;  // facing the light; these hide the other polygons
        for (std::int64_t i = 0; i + 1 < std::int64_t(start.size()); ++i)
            if (dot(direction, vector(normals[i])) > 0) facing.push_back(i);
        for (std::int64_t i : facing)
            for (std::int64_t at = start[i] + 2; at < start[i + 1]; ++at)
                map.draw(flat[places[start[i]]], flat[places[at - 1]], flat[places[at]]);
        reached[d].resize(places.size());
        for (std::int64_t i : facing)
            for (std::int64_t at = start[i]; at < start[i + 1]; ++at) reached[d][at] = map.lit(map.place(looked[at]));
    });
    parallel_for(start.size() - 1, 1024, [&](std::int64_t i) {
        for (std::size_t d = 0; d < directions.size(); ++d) {
            double share = dot(vector(directions[d]), vector(normals[i]));  // Lambert's cosine
            if (share <= 0) continue;
            for (std::int64_t at = start[i]; at < start[i + 1]; ++at) {
                whole[at] += share;
                if (reached[d][at]) light[at] += share;
            }
        }
    });
}

}  // namespace hexmend
