// Points as people keep them: a CSV file with columns x and z in metres, as long as it likes, read block by block.
//
// The first line may name columns; then x and z are found by name, and further columns are kept as they are. Without it each
// line is x,z and nothing else: a third number could as well mean that the second is a height. Cells may stand in double
// quotes (RFC 4180, but no line ends in them). Empty lines, blanks around cells and Windows' line ends don't matter.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pelagic::tools {

/// Some of the file's points, in its order.
struct PointBlock {
    std::vector<double> x, z;
    std::string text;                   ///< every column of every point, as written, with commas between
    std::vector<std::size_t> row_ends;  ///< where each point's part of the text ends

    std::size_t size() const { return x.size(); }
    std::string_view row(std::size_t i) const;
};

/// The cells of a line, blanks around them left out, quotes left in.
void split_cells(std::string_view line, std::vector<std::string_view>& cells);

/// What a cell says, without its quotes.
std::string cell_value(std::string_view cell);

class PointReader {
   public:
    /// \param name  of the file, for messages
    /// \param read  fills the bytes, returns how many, 0 at the end; may throw
    PointReader(std::string name, std::function<std::size_t(std::span<char>)> read);

    /// Reads on: at most `max_points`. False if no point is left. Throws InputError, one line that names the file, for a
    /// bad line its number and its text too; a file without any point is bad.
    bool read_block(PointBlock& block, std::size_t max_points);

    /// As the first line names them, as written; x and z without such a line. Known after the first block.
    const std::vector<std::string>& columns() const { return columns_; }
    bool is_x(std::size_t column) const { return column == x_column_; }
    bool is_z(std::size_t column) const { return column == z_column_; }

   private:
    bool next_line(std::string_view& line);
    void take_header();
    void take_point(std::string_view line, PointBlock& block);
    [[noreturn]] void reject(std::string_view line, const std::string& needs) const;

    std::string name_;
    std::function<std::size_t(std::span<char>)> read_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0, end_ = 0;  ///< of what is read and not yet used
    std::size_t line_number_ = 0;
    bool has_begun_ = false, has_points_ = false;
    std::vector<std::string_view> cells_;
    std::vector<std::string> columns_ = {"x", "z"};
    std::size_t x_column_ = 0, z_column_ = 1;
};

}  // namespace pelagic::tools
