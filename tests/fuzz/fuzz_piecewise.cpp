// Files of cuts and of trees, as they are, and with their checksums mended: else no change would come any further.

#include <cstring>
#include <span>
#include <vector>

#include <lightcuts/piecewise/cut_file.hpp>
#include <lightcuts/piecewise/tree_file.hpp>

#include "fuzz_target.hpp"

namespace {

using lightcuts::ClusterTree;
using Bytes = std::vector<std::byte>;

/// Of 64 leaves, each inner node of which has four children.
ClusterTree tree_of_fours() {
    std::vector<std::uint32_t> words;
    std::uint32_t item = 0;
    const auto add = [&](const auto& self, int depth) -> void {
        const auto first = static_cast<std::uint32_t>(words.size());
        if (depth == 0) {
            words.push_back(ClusterTree::leaf_word(item++));
            return;
        }
        for (int i = 0; i < 4; ++i) self(self, depth - 1);
        words.push_back(first);
    };
    add(add, 3);
    return ClusterTree(words);
}

void put_checksum(Bytes& bytes, std::size_t at, std::size_t size, std::span<const std::byte> of) {
    const std::uint64_t sum = lightcuts::detail::checksum(of);
    for (std::size_t i = 0; i < size; ++i) bytes[at + i] = static_cast<std::byte>(sum >> (8 * i) & 0xffu);
}

void read_cuts(const Bytes& bytes, const ClusterTree& tree) {
    const lightcuts::CutFile file(bytes, tree);
    lightcuts::PiecewiseConstant<float> f;
    for (std::size_t i = 0; i < file.size(); ++i) {
        file.read(i, f);
        validate(tree, f);
    }
}

}  // namespace

// The first byte says how the others are read.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const ClusterTree tree = tree_of_fours();
    if (size == 0) return -1;
    const int way = data[0] % 4;
    const lightcuts::CutEncoding encoding{data[0] & 4 ? lightcuts::ValueBits::eight : lightcuts::ValueBits::full,
                                          (data[0] & 8) != 0};
    return feed(data + 1, size - 1, [&](std::string_view text) {
        Bytes bytes(text.size());
        if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
        constexpr std::size_t header = lightcuts::detail::file_header_size;
        if (way == 0) {
            read_cuts(bytes, tree);
        } else if (way == 1) {
            if (bytes.size() >= header) put_checksum(bytes, 16, 8, std::span(bytes).subspan(header));
            lightcuts::read_tree(bytes);
        } else if (way == 2) {
            if (bytes.size() >= 4) put_checksum(bytes, 0, 4, std::span(bytes).subspan(4));
            lightcuts::PiecewiseConstant<float> f;
            decode(bytes, encoding, tree, f);
            validate(tree, f);
        } else {
            // A file of one cut, whose index is right.
            const lightcuts::CutFileWriter empty(tree, encoding);
            lightcuts::CutFileWriter one = empty;
            if (bytes.size() >= 4) put_checksum(bytes, 0, 4, std::span(bytes).subspan(4));
            one.append_encoded(bytes);
            read_cuts(one.bytes(), tree);
        }
    });
}
