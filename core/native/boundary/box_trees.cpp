#include <algorithm>

#include "boundary/closest_point.hpp"
#include "simd/threads.hpp"

namespace hexmend {
namespace {

// Trees of at least as many pieces are divided into parts that threads build; the result does not depend on them.
constexpr std::int32_t PART = 8192;
constexpr std::int64_t REFIT_PER_CHUNK = 512;  // nodes whose leaves a thread bounds at a time

using Box = std::array<double, SIDES>;
constexpr Box EMPTY{INF, INF, INF, -INF, -INF, -INF};

void include(Box &box, const Point &x) {
    for (int k = 0; k < 3; ++k) box[k] = std::min(box[k], x[k]), box[k + 3] = std::max(box[k + 3], x[k]);
}

void include(Box &box, const Box &other) {
    for (int k = 0; k < 3; ++k) box[k] = std::min(box[k], other[k]), box[k + 3] = std::max(box[k + 3], other[k + 3]);
}

Box box_of_children(const ChildSide *sides) {
    Box box = EMPTY;
    for (int i = 0; i < CHILDREN; ++i) {
        Box child;
        for (int k = 0; k < SIDES; ++k) child[k] = sides[k][i];
        include(box, child);
    }
    return box;
}

struct Item {
    Point centre;  // of the box of a piece
    std::int32_t piece;
};

// Nodes of trees; a part of a tree has its own, whose numbers begin at 0.
struct Nodes {
    std::vector<double> boxes;
    std::vector<std::int32_t> links;

    std::int32_t count() const { return static_cast<std::int32_t>(links.size() / CHILDREN); }

    std::int32_t add() {
        links.resize(links.size() + CHILDREN, NO_CHILD);
        boxes.resize(boxes.size() + SIDES * CHILDREN);
        return count() - 1;
    }

    void append(const Nodes &part) {
        std::int32_t before = count();
        boxes.insert(boxes.end(), part.boxes.begin(), part.boxes.end());
        for (std::int32_t link : part.links) links.push_back(link < 0 ? link : link + before);
    }
};

// A range of items that a thread builds, and the link to it.
struct Part {
    std::int32_t begin, end;
    std::size_t link;
    Nodes nodes;
};

struct TreeBuilder {
    std::vector<Item> items;

    TreeBuilder(Points points, std::span<const Piece> pieces) : items(pieces.size()) {
        parallel_for(pieces.size(), PART, [&](std::int64_t i) {
            auto [a, b, c] = pieces[i];
            for (int k = 0; k < 3; ++k) {
                auto [low, high] = std::minmax({points[a][k], points[b][k], points[c][k]});
                items[i].centre[k] = 0.5 * (low + high);
            }
            items[i].piece = static_cast<std::int32_t>(i);
        });
    }

    // Halve a range along the longest side of the box of its centres, leaves being full; return where the second
    // begins.
    std::int32_t halve(std::int32_t begin, std::int32_t end) {
        Box box = EMPTY;
        for (std::int32_t s = begin; s < end; ++s) include(box, items[s].centre);
        auto side = [&](int k) { return box[k + 3] - box[k]; };
        int axis = 0;
        for (int k = 1; k < 3; ++k)
            if (side(k) > side(axis)) axis = k;
        std::int32_t half = ((end - begin) / 2 + CHILDREN - 1) / CHILDREN * CHILDREN;
        auto at = items.begin();
        std::nth_element(at + begin, at + begin + half, at + end, [axis](const Item &one, const Item &other) {
            return std::pair(one.centre[axis], one.piece) < std::pair(other.centre[axis], other.piece);
        });
        return begin + half;
    }

    // Append the tree of a range; return its root. Ranges of at most `least` items become parts.
    std::int32_t add(Nodes &nodes, std::int32_t begin, std::int32_t end, std::int32_t least, std::vector<Part> *parts) {
        std::int32_t node = nodes.add(), bounds[CHILDREN + 1] = {begin, end, end, end, end};
        int count = 1;
        for (int halvings = 0; halvings < 2; ++halvings) {
            for (int i = count - 1; i >= 0; --i) {
                if (bounds[i + 1] - bounds[i] <= CHILDREN) continue;
                std::int32_t middle = halve(bounds[i], bounds[i + 1]);
                std::copy_backward(bounds + i + 1, bounds + count + 1, bounds + count + 2);
                bounds[i + 1] = middle;
                ++count;
            }
        }
        for (int i = 0; i < count; ++i) {
            std::int32_t first = bounds[i], pieces = bounds[i + 1] - first;
            std::size_t link = std::size_t{CHILDREN} * node + i;
            if (pieces <= CHILDREN) nodes.links[link] = -1 - (CHILDREN * first + pieces - 1);
            else if (parts && pieces <= least) parts->push_back({first, bounds[i + 1], link, {}});
            else {
                std::int32_t child = add(nodes, first, bounds[i + 1], least, parts);
                nodes.links[link] = child;
            }
        }
        return node;
    }

    // Append the tree of a range, parts of which threads build; return its root.
    std::int32_t add_tree(Nodes &nodes, std::int32_t begin, std::int32_t end) {
        if (end - begin < 2 * PART) return add(nodes, begin, end, 0, nullptr);
        std::vector<Part> parts;
        std::int32_t root = add(nodes, begin, end, PART, &parts);
        parallel(static_cast<std::int64_t>(parts.size()),
                 [&](std::int64_t i) { add(parts[i].nodes, parts[i].begin, parts[i].end, 0, nullptr); });
        for (const Part &part : parts) {
            nodes.links[part.link] = nodes.count();
            nodes.append(part.nodes);
        }
        return root;
    }
};

template <class T> std::span<T> rows(auto &values) {
    return {reinterpret_cast<T *>(values.data()), values.size() / std::tuple_size_v<T>};
}

}  // namespace

std::tuple<IntArray, TreeBoxes, TreeLinks, IntArray> build_trees(Points points, std::span<const Piece> pieces,
                                                                 Indices start) {
    expect(are_csr(start, pieces.size()), "start: its last number is expected to be the number of pieces");
    expect(pieces.size() < (std::size_t{1} << 29), "pieces: fewer than 2^29 are expected");
    TreeBuilder builder(points, pieces);
    Nodes nodes;
    std::vector<std::int32_t> roots, order(pieces.size());
    for (std::size_t t = 0; t + 1 < start.size(); ++t) {
        expect(start[t] >= 0 && start[t] < start[t + 1] && start[t + 1] <= static_cast<std::int64_t>(pieces.size()),
               "start does not ascend: expected at least one piece a tree");
        roots.push_back(builder.add_tree(nodes, start[t], start[t + 1]));
    }
    std::vector<Piece> ordered(pieces.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = builder.items[i].piece;
        ordered[i] = pieces[order[i]];
    }
    refit(points, ordered, rows<ChildLinks>(nodes.links), rows<ChildSide>(nodes.boxes));
    return {{std::move(order)}, {std::move(nodes.boxes)}, {std::move(nodes.links)}, {std::move(roots)}};
}

void refit(Points points, std::span<const Piece> pieces, std::span<const ChildLinks> links,
           std::span<ChildSide> boxes) {
    expect_boxes(boxes, links.size());
    auto set = [&](std::size_t node, int i, const Box &box) {
        for (int k = 0; k < SIDES; ++k) boxes[SIDES * node + k][i] = box[k];
    };
    parallel_for(links.size(), REFIT_PER_CHUNK, [&](std::int64_t node) {
        for (int i = 0; i < CHILDREN; ++i) {
            std::int32_t child = links[node][i];
            if (child >= 0) continue;
            Box box = EMPTY;
            if (child != NO_CHILD) {
                auto [first, count] = pieces_of(child);
                for (std::int32_t piece = first; piece < first + count; ++piece)
                    for (Node corner : pieces[piece]) include(box, points[corner]);
            }
            set(node, i, box);
        }
    });
    for (std::size_t node = links.size(); node-- > 0;)  // children follow their parents
        for (int i = 0; i < CHILDREN; ++i)
            if (std::int32_t child = links[node][i]; child >= 0)
                set(node, i, box_of_children(&boxes[std::size_t{SIDES} * child]));
}

}  // namespace hexmend
