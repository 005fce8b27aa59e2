// CSV files of points with columns x and z in metres, of any length, read in blocks.
//
// The first line may name columns. Then x, z and a height y are found by name, and further columns are
// copied unchanged. Without names, each line is x,z only, because with a third number the second could be
// a height. Cells may be in double quotes (RFC 4180, but without line ends). Empty lines, blanks
// around cells and Windows line ends are ignored.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pelagic::tools {

/// A block of consecutive points of the file.
struct PointBlock {
    std::vector<double> x, z;
    std::vector<double> y;              ///< empty without a column y
    std::string text;                   ///< all columns of all points, unchanged, with commas
    std::vector<std::size_t> row_ends;  ///< end of each point's row in the text

    std::size_t size() const { return x.size(); }
    std::string_view row(std::size_t i) const;
};

/// Splits a line into cells without surrounding blanks. Quotes are kept.
void split_cells(std::string_view line, std::vector<std::string_view>& cells);

/// Returns the value of a cell without its quotes.
std::string cell_value(std::string_view cell);

class PointReader {
   public:
    /// \param name  name of the file, for messages
    /// \param read  fills a buffer and returns the number of bytes, 0 at the end; may throw
    PointReader(std::string name, std::function<std::size_t(std::span<char>)> read);

    /// Reads the next block of at most `max_points`. Returns false if no points remain.
    /// \throws InputError  on one line with the file's name, for an invalid line (with its number
    ///                     and text) and for a file without points
    bool read_block(PointBlock& block, std::size_t max_points);

    /// Returns the column names of the first line, unchanged, or x and z if it names none. Valid
    /// after the first block.
    const std::vector<std::string>& columns() const { return columns_; }
    bool is_x(std::size_t column) const { return column == x_column_; }
    bool is_y(std::size_t column) const { return column == y_column_; }
    bool is_z(std::size_t column) const { return column == z_column_; }
    /// Returns whether the points have heights. Valid after the first block.
    bool has_y() const { return y_column_ != no_column; }

    /// Rejects lines with a lower y as invalid. \param name  of that height, for messages
    void set_min_y(double y_m, std::string name) {
        min_y_m_ = y_m;
        min_y_name_ = std::move(name);
    }

   private:
    bool next_line(std::string_view& line);
    void take_header();
    void take_point(std::string_view line, PointBlock& block);
    [[noreturn]] void reject(std::string_view line, const std::string& needs) const;

    std::string name_;
    std::function<std::size_t(std::span<char>)> read_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0, end_ = 0;  ///< range of unprocessed bytes in the buffer
    std::size_t line_number_ = 0;
    bool has_begun_ = false, has_points_ = false;
    std::vector<std::string_view> cells_;
    std::vector<std::string> columns_ = {"x", "z"};
    static constexpr std::size_t no_column = static_cast<std::size_t>(-1);
    std::size_t x_column_ = 0, y_column_ = no_column, z_column_ = 1;
    double min_y_m_ = -std::numeric_limits<double>::infinity();
    std::string min_y_name_;
};

}  // namespace pelagic::tools
