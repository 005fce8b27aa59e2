// Stage `columns+textures` of a cascade without planes: transforms columns in place and computes
// their textures while the displacement is in the second-level cache.
//
// A job processes a band of columns in strips. The textures of a strip follow as soon as the column
// blocks on both sides are there. Stage `edge columns` transforms the blocks at the limits of bands
// before, so that bands do not wait for each other.
#pragma once

#include <cstddef>
#include <functional>

namespace pelagic {

/// Columns of a cascade whose textures can be computed.
struct TextureStrip {
    std::size_t first_column, columns;
};

/// Transforms a pair of column blocks (column_block_pair()).
using TransformColumns = std::function<void(std::size_t pair)>;

/// The bands of a cascade. Groups are 32 adjacent columns, whose blocks share transforms.
class TextureBands {
   public:
    TextureBands(int resolution, std::size_t lanes);

    /// Returns whether a frame of this resolution should use bands. Smaller surfaces stay in the
    /// second-level cache as a whole. Strips of larger ones have 32 columns: 2 % fewer bytes beyond
    /// 1 MB and 11 % more instructions at N = 1024.
    static bool are_worthwhile(int resolution) { return resolution == 256 || resolution == 512; }

    std::size_t groups() const { return groups_; }
    std::size_t groups_per_band() const { return groups_per_band_; }
    /// Returns the number of pairs of blocks at the limits of bands.
    std::size_t edges() const { return 2 * groups_ / groups_per_band_; }
    /// Returns the number of the pair at a limit. \param edge  in [0, edges())
    std::size_t edge_pair(std::size_t edge) const;

    /// Processes the band of the groups [begin, end). \pre the pairs of all edges are transformed
    /// \param make  computes the textures of a strip
    void process(std::size_t begin, std::size_t end, const TransformColumns& transform,
                 const std::function<void(const TextureStrip&)>& make) const;

   private:
    std::size_t pairs_a_group_, groups_, groups_per_band_, groups_a_strip_;
};

}  // namespace pelagic
