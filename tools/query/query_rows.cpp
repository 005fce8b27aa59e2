#include "pelagic/tools/query/query_rows.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <set>

#include "pelagic/message/utf8.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

constexpr std::size_t pieces_per_block = 32;

/// Maximum length of a row without the file's columns. Memory is reserved in advance, because a job
/// must not throw. A number has at most 25 characters, its JSON key 24.
constexpr std::size_t max_row_length = (ResultColumns::max_values + 5) * (25 + 24);
/// Length of an escaped control character in JSON, \u001f.
constexpr std::size_t max_escaped_length = 6;

void append_json_escaped(std::string& out, std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t bytes = utf8_character_bytes(text, at);
        const auto code = static_cast<unsigned char>(text[at]);
        if (bytes == 0)
            out += "\xEF\xBF\xBD";  // U+FFFD replaces invalid bytes
        else if (code < 0x20)
            out.append("\\u00").append({digits[code >> 4], digits[code & 15]});
        else if (code == '"' || code == '\\')
            out.append({'\\', text[at]});
        else
            out += text.substr(at, bytes);
        at += std::max<std::size_t>(1, bytes);
    }
}

/// Appends the value of a cell as a JSON string. In a quoted cell, two quotes represent one.
void append_json_cell(std::string& out, std::string_view cell) {
    const bool is_quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
    if (is_quoted) cell = cell.substr(1, cell.size() - 2);
    out += '"';
    for (std::size_t pair; is_quoted && (pair = cell.find("\"\"")) != std::string_view::npos;
         cell.remove_prefix(pair + 2))
        append_json_escaped(out, cell.substr(0, pair + 1));
    append_json_escaped(out, cell);
    out += '"';
}

/// Appends a number, or null if it is not finite, which JSON cannot represent. The error of a point
/// without a solution is infinite.
void append_json_number(std::string& out, auto value) {
    if (std::isfinite(value))
        append_number(out, value);
    else
        out += "null";
}

}  // namespace

void write_output(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size()) return;
    throw FileError(std::string("can't write standard output: ") + std::strerror(errno));
}

void ResultColumns::resize(std::size_t points) {
    for (std::vector<float>& values : values_) values.resize(points);
    if (has_converged_) converged_.resize(points);
}

SampleBuffers::SampleBuffers(bool has_foam, bool has_depth)
    : ResultColumns({"height", "nx", "ny", "nz", "vx", "vy", "vz", "jacobian", "error_m"}, true),
      has_foam_(has_foam),
      has_depth_(has_depth) {
    if (has_foam) names_.push_back("foam");
    if (has_depth) names_.push_back("depth");
    values_.resize(names_.size());
}

SurfaceSamples SampleBuffers::samples(std::size_t first, std::size_t count) {
    const auto of = [&](std::size_t value) { return std::span(values_[value]).subspan(first, count); };
    return {.height_m = of(0),
            .normal_x = of(1),
            .normal_y = of(2),
            .normal_z = of(3),
            .jacobian = of(7),
            .velocity_x_mps = of(4),
            .velocity_y_mps = of(5),
            .velocity_z_mps = of(6),
            .error_m = of(8),
            .converged = std::span(converged_).subspan(first, count),
            .foam = has_foam_ ? of(9) : std::span<float>()};
}

WaterBuffers::WaterBuffers()
    : ResultColumns({"pressure_pa", "velocity_x_mps", "velocity_y_mps", "velocity_z_mps", "acceleration_x_mps2",
                     "acceleration_y_mps2", "acceleration_z_mps2", "depth_below_surface_m"},
                    false) {}

WaterSamples WaterBuffers::samples(std::size_t first, std::size_t count) {
    const auto of = [&](std::size_t value) { return std::span(values_[value]).subspan(first, count); };
    return {.depth_m = of(7),
            .pressure_pa = of(0),
            .velocity_x_mps = of(1),
            .velocity_y_mps = of(2),
            .velocity_z_mps = of(3),
            .acceleration_x_mps2 = of(4),
            .acceleration_y_mps2 = of(5),
            .acceleration_z_mps2 = of(6)};
}

RowWriter::RowWriter(std::shared_ptr<Executor> executor, const ResultColumns& results,
                     std::string_view interpolation, bool as_json, bool has_times)
    : results_(results),
      interpolation_(interpolation),
      as_json_(as_json),
      has_times_(has_times),
      pieces_(pieces_per_block),
      executor_(std::move(executor)) {
    graph_.add({.name = "rows", .count = pieces_per_block, .body = [this](std::size_t begin, std::size_t end) {
                    for (std::size_t piece = begin; piece < end; ++piece) fill_piece(piece);
                }});
    run_ = executor_->prepare(graph_);
}

void RowWriter::begin(const PointReader& reader) {
    reader_ = &reader;
    std::set<std::string> taken(results_.names().begin(), results_.names().end());
    if (results_.has_converged()) taken.insert("converged");
    if (as_json_) taken.insert("interpolation");
    if (has_times_) taken.insert("time");
    std::string header = has_times_ ? "time," : "";
    json_keys_.clear();
    for (const std::string& column : reader.columns()) {
        const std::string name = cell_value(column);
        if (!taken.insert(name).second)
            throw InputError("the points' column " + name +
                             " has the name of another column or of a result, expected its own");
        header += column + ",";
        append_json_cell(json_keys_.emplace_back(), column);
    }
    for (const char* name : results_.names()) header.append(name).append(",");
    if (results_.has_converged())
        header += "converged";
    else
        header.pop_back();
    write_output(as_json_ ? "[" : header + "\n");
}

void RowWriter::append_csv(std::string& text, std::size_t point) const {
    if (has_times_) {
        append_number(text, time_s_);
        text += ',';
    }
    text += block_->row(point);
    for (std::size_t column = 0; column < results_.names().size(); ++column) {
        text += ',';
        append_number(text, results_.value(column, point));
    }
    if (results_.has_converged()) text += results_.converged(point) ? ",1" : ",0";
    text += '\n';
}

void RowWriter::append_json(std::string& text, std::size_t point, std::vector<std::string_view>& cells) const {
    text += point == 0 && !has_rows_ ? "\n{" : ",\n{";
    if (has_times_) {
        text += "\"time\":";
        append_number(text, time_s_);
        text += ',';
    }
    split_cells(block_->row(point), cells);
    for (std::size_t column = 0; column < cells.size(); ++column) {
        text.append(json_keys_[column]).append(":");
        if (reader_->is_x(column))
            append_number(text, block_->x[point]);
        else if (reader_->is_y(column))
            append_number(text, block_->y[point]);
        else if (reader_->is_z(column))
            append_number(text, block_->z[point]);
        else
            append_json_cell(text, cells[column]);
        text += ',';
    }
    for (std::size_t column = 0; column < results_.names().size(); ++column) {
        text.append("\"").append(results_.names()[column]).append("\":");
        append_json_number(text, results_.value(column, point));
        text += ',';
    }
    text.append("\"interpolation\":\"").append(interpolation_).append("\"");
    if (results_.has_converged()) text += results_.converged(point) ? ",\"converged\":true" : ",\"converged\":false";
    text += '}';
}

void RowWriter::fill_piece(std::size_t piece) {
    Piece& out = pieces_[piece];
    const std::size_t begin = block_->size() * piece / pieces_per_block,
                      end = block_->size() * (piece + 1) / pieces_per_block;
    for (std::size_t point = begin; point < end; ++point)
        as_json_ ? append_json(out.text, point, out.cells) : append_csv(out.text, point);
}

void RowWriter::write(const PointBlock& block, double time_s) {
    block_ = &block;
    time_s_ = time_s;
    std::size_t key_length = 0;
    for (const std::string& key : json_keys_) key_length += key.size() + 2;
    for (std::size_t piece = 0; piece < pieces_per_block; ++piece) {
        const std::size_t begin = block.size() * piece / pieces_per_block,
                          end = block.size() * (piece + 1) / pieces_per_block;
        const std::size_t own =
            end == begin ? 0 : block.row_ends[end - 1] - (begin == 0 ? 0 : block.row_ends[begin - 1]);
        pieces_[piece].text.clear();
        pieces_[piece].text.reserve((end - begin) *
                                        (max_row_length + (as_json_ ? key_length + 4 * json_keys_.size() : 0)) +
                                    own * (as_json_ ? max_escaped_length : 1));
        pieces_[piece].cells.reserve(json_keys_.size());
    }
    run_->schedule();
    run_->complete();
    for (const Piece& piece : pieces_) write_output(piece.text);
    has_rows_ = has_rows_ || block.size() > 0;
}

void RowWriter::end() {
    if (as_json_) write_output("\n]\n");
}

}  // namespace pelagic::tools
