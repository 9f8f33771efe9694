// What nodes of the boundary slide on: each is put back on its own curve or patch.
#pragma once

#include "closest.hpp"

namespace hexmend {

struct Ground {
    Indices slots;  // of each node among those that slide, -1 of others
    Indices roots;  // of each of those its tree
    Pieces pieces;

    bool slides(Node i) const { return slots[i] >= 0; }

    // The closest place to x of what node i slides on; x itself where that is not finite.
    Point put_back(Node i, const Point &x) const {
        Closest found = pieces.closest(x, roots[slots[i]]);
        return found.piece < 0 ? x : found.place;
    }
};

}  // namespace hexmend
