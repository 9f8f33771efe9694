// Closest points of points that move little from one query to the next: the pieces nearest to each are kept, and prove
// in most queries which point is the closest, so that the tree is not searched.
#pragma once

#include <memory>
#include <vector>

#include "boundary/closest_point.hpp"

namespace hexmend {

struct FourPieces;

class ClosestPointCache {
  public:
    // For a point in each slot, in the tree with the slot's root.
    ClosestPointCache(const BoxTrees &trees, Indices roots);
    ClosestPointCache(const ClosestPointCache &) = delete;
    ~ClosestPointCache();

    std::size_t size() const { return slots_.size(); }

    // As `BoxTrees::closest`, for the point in a slot, with the same result. Threads may call it at once.
    ClosestPoint closest(std::int32_t slot, const Point &x) const;

  private:
    // Fours of pieces that are kept of a slot, nearest first.
    static constexpr int FOURS = 2;

    // No piece but those of the first n fours is nearer to the centre than radius[n - 1]. So none is nearer to a point
    // x than that minus the distance of x from the centre.
    struct Slot {
        Point centre;
        double radius[FOURS];
        std::int32_t root, last;  // piece on which the point was last, -1 for none
        std::int32_t is_in_use;   // by a thread
        bool has_pieces, has_served;
        std::int8_t failures, wait;  // lists in turn that served no query; queries until the next list
    };

    static bool wants_pieces(Slot &slot);
    ClosestPoint closest_of_tree(Slot &slot, FourPieces *fours, const Point &x, std::int32_t known,
                                 double farthest) const;
    static bool is_proved(Slot &slot, const FourPieces *fours, const Point &x, ClosestPoint &best, double &farthest);

    BoxTrees trees_;
    mutable std::vector<Slot> slots_;
    std::unique_ptr<FourPieces[]> fours_;  // of slot s: from FOURS * s on
};

// Write the piece, closest point and barycentric weights of each x, the point in a slot.
void closest_of_slots(const ClosestPointCache &cache, Indices slots, Points x, std::span<std::int32_t> piece,
                      std::span<Point> places, std::span<Barycentric> weights);

}  // namespace hexmend
