#include "pelagic/tools/query/points_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

// Larger than any ocean; doubles still resolve metres here.
constexpr double farthest_m = 1e15;
constexpr const char* a_point = "x,z: two numbers of metres in [-1e15, 1e15]";
constexpr const char* a_water_point = "x,y,z: three numbers of metres in [-1e15, 1e15]";

// Limits of the memory use, independent of the file's length. Longer lines are rejected.
constexpr std::size_t max_line_length = std::size_t{1} << 16;
constexpr std::size_t max_block_text = std::size_t{4} << 20;
constexpr std::size_t buffer_size = 2 * max_line_length;

std::optional<double> coordinate(std::string_view text) {
    const auto value = parse_number(text);
    return value && std::fabs(*value) <= farthest_m ? value : std::nullopt;
}

/// Returns the end of the cell that begins at `at`: the next comma outside of quotes.
std::size_t cell_end(std::string_view line, std::size_t at) {
    bool is_quoted = false;
    for (; at < line.size() && (is_quoted || line[at] != ','); ++at)
        if (line[at] == '"') is_quoted = !is_quoted;
    return at;
}

}  // namespace

std::string_view PointBlock::row(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : row_ends[i - 1];
    return std::string_view(text).substr(begin, row_ends[i] - begin);
}

void split_cells(std::string_view line, std::vector<std::string_view>& cells) {
    cells.clear();
    for (std::size_t at = 0;;) {
        const std::size_t end = cell_end(line, at);
        cells.push_back(trimmed(line.substr(at, end - at)));
        if (end == line.size()) return;
        at = end + 1;
    }
}

std::string cell_value(std::string_view cell) {
    if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return std::string(cell);
    std::string value;
    for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
        value += cell[i];
        if (cell[i] == '"' && cell[i + 1] == '"' && i + 2 < cell.size()) ++i;
    }
    return value;
}

PointReader::PointReader(std::string name, std::function<std::size_t(std::span<char>)> read)
    : name_(std::move(name)), read_(std::move(read)), buffer_(buffer_size) {}

void PointReader::reject(std::string_view line, const std::string& needs) const {
    throw InputError(name_ + ":" + number_text(line_number_) + ": the line is " + std::string(line.substr(0, 80)) +
                     ", expected " + needs);
}

bool PointReader::next_line(std::string_view& line) {
    std::size_t searched = begin_;
    for (;;) {
        const void* const newline = std::memchr(buffer_.data() + searched, '\n', end_ - searched);
        const std::size_t stop =
            newline ? static_cast<std::size_t>(static_cast<const char*>(newline) - buffer_.data()) : end_;
        if (stop - begin_ > max_line_length)
            throw InputError(name_ + ":" + number_text(line_number_ + 1) + ": the line has more than " +
                             number_text(max_line_length) + " characters, expected " + a_point);
        if (newline) {
            line = {buffer_.data() + begin_, stop - begin_};
            begin_ = stop + 1;
            ++line_number_;
            return true;
        }
        std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
                  buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
        end_ -= std::exchange(begin_, 0);
        searched = end_;
        const std::size_t got = read_({buffer_.data() + end_, buffer_.size() - end_});
        end_ += got;
        if (got > 0) continue;
        if (end_ == 0) return false;
        line = {buffer_.data(), end_};  // the last line has no newline
        begin_ = end_;
        ++line_number_;
        return true;
    }
}

void PointReader::take_header() {
    columns_.clear();
    for (const std::string_view cell : cells_) {
        if (cell_value(cell) == "x") x_column_ = columns_.size();
        if (cell_value(cell) == "y") y_column_ = columns_.size();
        if (cell_value(cell) == "z") z_column_ = columns_.size();
        columns_.emplace_back(cell);
    }
}

void PointReader::take_point(std::string_view line, PointBlock& block) {
    if (cells_.size() != columns_.size()) {
        if (columns_.size() == 2 && cells_.size() > 2)
            reject(line, std::string(a_point) + ", or a first line that names columns, x and z among them");
        reject(line, columns_.size() == 2 ? a_point : number_text(columns_.size()) + " columns, as the first line");
    }
    const auto x = coordinate(cells_[x_column_]), z = coordinate(cells_[z_column_]);
    if (!x || !z) reject(line, a_point);
    if (has_y()) {
        const auto y = coordinate(cells_[y_column_]);
        if (!y) reject(line, a_water_point);
        if (*y < min_y_m_) reject(line, "y of at least " + number_text(min_y_m_) + ", " + min_y_name_);
        block.y.push_back(*y);
    }
    block.x.push_back(*x);
    block.z.push_back(*z);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        if (i > 0) block.text += ',';
        block.text += cells_[i];
    }
    block.row_ends.push_back(block.text.size());
}

bool PointReader::read_block(PointBlock& block, std::size_t max_points) {
    block.x.clear();
    block.y.clear();
    block.z.clear();
    block.text.clear();
    block.row_ends.clear();
    std::string_view line;
    while (block.size() < max_points && block.text.size() < max_block_text && next_line(line)) {
        line = trimmed(line);
        // Skips a byte order mark.
        if (line_number_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
        if (line.empty()) continue;
        if (std::count(line.begin(), line.end(), '"') % 2 != 0) reject(line, "an end of its quotes");
        split_cells(line, cells_);
        if (!std::exchange(has_begun_, true)) {
            const auto times = [&](const char* name) {
                return std::count_if(cells_.begin(), cells_.end(),
                                     [&](std::string_view cell) { return cell_value(cell) == name; });
            };
            if (times("x") > 1 || times("z") > 1) reject(line, "one column x and one column z");
            if (times("y") > 1) reject(line, "at most one column y");
            if (times("x") == 1 && times("z") == 1) {
                take_header();
                continue;
            }
        }
        take_point(line, block);
    }
    has_points_ = has_points_ || block.size() > 0;
    if (!has_points_) throw InputError(name_ + " holds no points, expected lines " + a_point);
    return block.size() > 0;
}

}  // namespace pelagic::tools
