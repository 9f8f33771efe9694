// One line-searched step per free node: a sweep of local optimisation, colour by colour.
#pragma once

#include <tuple>

#include "energy/objective_norm.hpp"
#include "mesh/array_views.hpp"

namespace hexmend {

enum Direction { STEEPEST_DESCENT, NEWTON, MODIFIED_NEWTON };

// What becomes of a node that is visited.
enum StepStatus { MOVED, NO_DESCENT, FLAT, INFINITE };

// What a method does at a node; lengths are in mean edge lengths of the patch.
struct LocalStep {
    int direction;
    double delta;
    ObjectiveNorm power;
    double first, shrink, c1;
    int cuts;
};

std::int64_t sweep(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices groups, Indices nodes,
                   int direction, double delta, ObjectiveNorm power, double first, double shrink, double c1, int cuts);

std::tuple<double, double, std::array<double, 3>, std::array<double, 6>> look(Points points, Hexes hexes, Indices star,
                                                                              double factor, double delta,
                                                                              ObjectiveNorm power);

std::tuple<int, std::array<double, 3>, double, bool, double, double, std::array<double, 3>, OwnedArray<double, 3>>
visit(Points points, Hexes hexes, Indices star, int direction, double delta, ObjectiveNorm power, double first,
      double shrink, double c1, int cuts);

void along(Points points, Hexes hexes, Indices star, double factor, std::array<double, 3> direction, double delta,
           ObjectiveNorm power, std::span<std::array<double, 2>> curve);

}  // namespace hexmend
