#include "mesh/refinement.hpp"

#include <bit>
#include <optional>

namespace hexmend {
namespace {

// Role of a node in the coarse mesh: the number of coordinates in which it is in the middle.
enum Kind : std::int8_t { UNKNOWN = -1, VERTEX = 0, OF_EDGE = 1, OF_FACE = 2, CENTRE = 3 };

constexpr int bits(int corner) {
    auto [x, y, z] = UNIT_CUBE[corner];
    return x + 2 * y + 4 * z;
}

// The corner at the other end of the diagonal, and that with some coordinates flipped.
constexpr auto FLIPPED = [] {
    std::array<std::array<int, 8>, 8> flipped{};
    for (int c = 0; c < 8; ++c)
        for (int k = 0; k < 8; ++k)
            for (int to = 0; to < 8; ++to)
                if (bits(to) == (bits(c) ^ k)) flipped[c][k] = to;
    return flipped;
}();

constexpr auto KINDS = [] {
    std::array<std::array<std::int8_t, 8>, 8> kinds{};
    for (int vertex = 0; vertex < 8; ++vertex)
        for (int c = 0; c < 8; ++c)
            kinds[vertex][c] = static_cast<std::int8_t>(std::popcount(unsigned(bits(vertex) ^ bits(c))));
    return kinds;
}();

// Finds which corner of each hex is a vertex of the coarse mesh: hexes at a vertex have it there, and those at a centre
// opposite. What one node is therefore says it of all hexes that are connected.
class VertexSearch {
  public:
    explicit VertexSearch(const HexMesh &mesh)
        : mesh_(mesh), kind_(mesh.start.size() - 1, UNKNOWN), vertex_(mesh.hexes.size(), -1) {}

    // Find the vertex of every hex; false where there is no consistent choice.
    bool find() { return spread_to_all() && has_ends(); }

    int vertex(std::int64_t hex) const { return vertex_[hex]; }

  private:
    bool spread_to_all() {
        for (std::size_t i = 0; i < kind_.size(); ++i)  // an odd number of hexes meets at vertices alone
            if (mesh_.star(Node(i)).size() % 2 && kind_[i] != VERTEX && !spread(Node(i))) return false;
        for (std::size_t h = 0; h < vertex_.size(); ++h) {
            if (vertex_[h] >= 0) continue;
            bool found = false;
            for (int c = 0; c < 8 && !found; ++c) {
                found = spread(mesh_.hexes[h][c]);
                if (!found) undo();
            }
            if (!found) return false;
        }
        return true;
    }

    // True if two vertices are around each node in the middle of an edge, and four around each in that of a face.
    bool has_ends() const {
        for (std::size_t i = 0; i < kind_.size(); ++i) {
            if (kind_[i] != OF_EDGE && kind_[i] != OF_FACE) continue;
            Node ends[5];
            int size = 0;
            for (auto corner : mesh_.star(Node(i))) {
                placed(ends, size, mesh_.hexes[corner / 8][vertex_[corner / 8]]);
                if (size > 4) return false;
            }
            if (size != (kind_[i] == OF_EDGE ? 2 : 4)) return false;
        }
        return true;
    }

    // Make a node a vertex, and follow what that implies; false at a contradiction.
    bool spread(Node seed) {
        queue_.clear(), reached_.clear(), named_.clear();
        if (kind_[seed] != UNKNOWN) return false;
        name(seed, VERTEX);
        for (std::size_t at = 0; at < queue_.size(); ++at) {
            Node node = queue_[at];
            Star star = mesh_.star(node);
            if (kind_[node] == CENTRE && star.size() != 8) return false;
            for (auto corner : star)
                if (!visit(corner / 8, kind_[node] == VERTEX ? corner % 8 : FLIPPED[corner % 8][7])) return false;
        }
        return true;
    }

    bool visit(std::int64_t hex, int vertex) {
        if (vertex_[hex] >= 0) return vertex_[hex] == vertex;
        vertex_[hex] = static_cast<std::int8_t>(vertex);
        reached_.push_back(std::int32_t(hex));
        for (int c = 0; c < 8; ++c) {
            Node node = mesh_.hexes[hex][c];
            auto kind = Kind(KINDS[vertex][c]);
            if (kind_[node] == UNKNOWN) name(node, kind);
            else if (kind_[node] != kind) return false;
        }
        return true;
    }

    void name(Node node, Kind kind) {
        kind_[node] = kind;
        named_.push_back(node);
        if (kind == VERTEX || kind == CENTRE) queue_.push_back(node);
    }

    void undo() {
        for (auto hex : reached_) vertex_[hex] = -1;
        for (auto node : named_) kind_[node] = UNKNOWN;
    }

    const HexMesh &mesh_;
    std::vector<std::int8_t> kind_, vertex_;
    std::vector<Node> queue_, named_;
    std::vector<std::int32_t> reached_;
};

// Puts the eight hexes around a centre together.
class BlockBuilder {
  public:
    BlockBuilder(const HexMesh &mesh, const VertexSearch &search) : mesh_(mesh), search_(search) {}

    std::optional<Block> build(Node centre) {
        Star star = mesh_.star(centre);
        block_.fill(-1), block_[13] = centre;
        auto [x, y, z] = UNIT_CUBE[search_.vertex(star[0] / 8)];
        const int sides[3] = {2 * x, 2 * y, 2 * z};
        for (int axis = 0; axis < 3; ++axis) block_[face(axis, sides[axis])] = neighbour(star[0], axis);
        bool placed[8] = {};
        int left = 8;
        for (bool progress = true; left && progress;) {
            progress = false;
            for (int k = 0; k < 8; ++k) {
                if (placed[k] || !place(star[k])) continue;
                placed[k] = progress = true, --left;
            }
        }
        if (left || failed_ || std::ranges::count(block_, -1)) return std::nullopt;
        return block_;
    }

  private:
    static constexpr int at(const int (&p)[3]) { return 9 * p[2] + 3 * p[1] + p[0]; }

    static constexpr int face(int axis, int side) {
        int p[3] = {1, 1, 1};
        p[axis] = side;
        return at(p);
    }

    // The node that shares the edge along an axis of the hex with this corner of it.
    Node neighbour(std::int32_t corner, int axis) const {
        return mesh_.hexes[corner / 8][FLIPPED[corner % 8][1 << axis]];
    }

    // Place a hex by those two of its three nodes in the middle of faces that are known; false where fewer are.
    bool place(std::int32_t corner) {
        int axis_of[3], side_of[3], unknown = -1, used = 0;
        for (int k = 0; k < 3; ++k) {
            Node node = neighbour(corner, k);
            axis_of[k] = -1;
            for (int axis = 0; axis < 3; ++axis)
                for (int side : {0, 2})
                    if (block_[face(axis, side)] == node) axis_of[k] = axis, side_of[k] = side;
            if (axis_of[k] >= 0) {
                used |= 1 << axis_of[k];
            } else if (unknown >= 0) {
                return false;
            } else {
                unknown = k;
            }
        }
        if (unknown >= 0) {
            int axis = used == 6 ? 0 : used == 5 ? 1 : used == 3 ? 2 : -1;
            if (axis < 0) return failed_ = true;
            int side = block_[face(axis, 0)] < 0 ? 0 : 2;
            axis_of[unknown] = axis, side_of[unknown] = side, used |= 1 << axis;
            put(face(axis, side), neighbour(corner, unknown));
        }
        if (used != 7) return failed_ = true;
        for (int flips = 3; flips < 8; ++flips) {
            if (std::popcount(unsigned(flips)) < 2) continue;
            int p[3] = {1, 1, 1};
            for (int k = 0; k < 3; ++k)
                if (flips >> k & 1) p[axis_of[k]] = side_of[k];
            put(at(p), mesh_.hexes[corner / 8][FLIPPED[corner % 8][flips]]);
        }
        return true;
    }

    void put(int place, Node node) {
        failed_ |= block_[place] >= 0 && block_[place] != node;
        block_[place] = node;
    }

    const HexMesh &mesh_;
    const VertexSearch &search_;
    Block block_{};
    bool failed_ = false;
};

}  // namespace

OwnedArray<Node, 27> coarse_blocks(Hexes hexes, Indices start, Indices corners) {
    expect_corners(hexes.size(), start, corners);
    OwnedArray<Node, 27> blocks;
    auto is_hex = [](const Hex &row) { return kind_of(row) == HEXAHEDRON; };
    if (hexes.empty() || hexes.size() % 8 || !std::ranges::all_of(hexes, is_hex)) return blocks;
    HexMesh mesh{hexes, start, corners};
    VertexSearch search(mesh);
    if (!search.find()) return blocks;
    BlockBuilder builder(mesh, search);
    blocks.values.reserve(27 * (hexes.size() / 8));
    for (std::size_t h = 0; h < hexes.size(); ++h) {
        Node centre = hexes[h][FLIPPED[search.vertex(h)][7]];
        if (mesh.star(centre)[0] / 8 != std::int32_t(h)) continue;
        auto block = builder.build(centre);
        if (!block) return {};
        blocks.values.insert(blocks.values.end(), block->begin(), block->end());
    }
    return blocks;
}

void interpolate_blocks(ArrayView<const Node, 27> blocks, std::span<const bool> kept, std::span<Point> values) {
    expect(kept.size() == values.size(), "kept must have a number for each of the values");
    for (const auto &block : blocks) {
        V3<double> v[27];
        for (int k = 0; k < 27; ++k) v[k] = vector(values[block[k]]);
        auto pairs = [&](int a, int b, int c, int d) { return (v[a] + v[b]) + (v[c] + v[d]); };
        auto set = [&](int k, const V3<double> &value) {
            if (!kept[block[k]]) v[k] = value;
        };
        // Sums of opposite pairs: they do not depend on the axes of the hex, which its neighbours number otherwise.
        constexpr int STRIDE[3] = {1, 3, 9};
        V3<double> edges{}, faces{}, vertices{};
        for (int axis = 0; axis < 3; ++axis) {
            int s = STRIDE[axis], t = STRIDE[(axis + 1) % 3], u = STRIDE[(axis + 2) % 3];
            for (int at : {13 - t - u, 13 - t + u, 13 + t - u, 13 + t + u}) set(at, 0.5 * (v[at - s] + v[at + s]));
            edges += pairs(13 - t - u, 13 + t + u, 13 - t + u, 13 + t - u);
        }
        for (int axis = 0; axis < 3; ++axis) {
            int s = STRIDE[axis], t = STRIDE[(axis + 1) % 3], u = STRIDE[(axis + 2) % 3];
            for (int at : {13 - s, 13 + s}) {
                auto around = pairs(at - t, at + t, at - u, at + u);
                auto ends = pairs(at - t - u, at + t + u, at - t + u, at + t - u);
                set(at, 0.5 * around - 0.25 * ends);
                if (axis == 0) vertices += ends;
            }
            faces += v[13 - s] + v[13 + s];
        }
        set(13, 0.5 * faces - 0.25 * edges + 0.125 * vertices);
        for (int k = 0; k < 27; ++k) values[block[k]] = point(v[k]);
    }
}

}  // namespace hexmend
