// Output of `pelagic query`: one row per point, as CSV or as JSON.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tools/query/points_file.hpp"

namespace pelagic::tools {

/// Writes to standard output. \throws FileError  if that fails
void write_output(std::string_view text);

/// Results of the queries of a block of points.
class SampleBuffers {
   public:
    static constexpr std::size_t max_values = 11;

    SampleBuffers(bool has_foam, bool has_depth);

    /// Returns the names of the values in the order of the columns. The column `converged` follows
    /// them.
    std::span<const char* const> names() const { return std::span(names_).first(values_there_); }

    void resize(std::size_t points);
    SurfaceSamples samples();
    /// Returns the still-water depths over a shore in metres; empty without that column.
    std::span<float> depths() { return values_[depth_at]; }
    float value(std::size_t column, std::size_t point) const { return values_[columns_[column]][point]; }
    bool converged(std::size_t point) const { return converged_[point] != 0; }

   private:
    static constexpr std::array<const char*, max_values> all_names = {
        "height", "nx", "ny", "nz", "vx", "vy", "vz", "jacobian", "error_m", "foam", "depth"};
    static constexpr std::size_t foam_at = 9, depth_at = 10;

    std::array<const char*, max_values> names_;
    std::array<std::size_t, max_values> columns_;  ///< index of the value of each column
    std::size_t values_there_ = 0;
    std::array<std::vector<float>, max_values> values_;
    std::vector<std::uint8_t> converged_;
};

/// Formats blocks as text, several pieces in parallel, and writes them to standard output in order.
class RowWriter {
   public:
    /// \param samples        results of the block that write() receives; must outlive the writer
    /// \param interpolation  interpolation of the queries, which JSON rows contain
    /// \param has_times      true if rows begin with the time
    RowWriter(std::shared_ptr<Executor> executor, const SampleBuffers& samples, Interpolation interpolation,
              bool as_json, bool has_times);

    /// Writes the header or the opening bracket.
    /// \throws InputError  if a column of the file has the name of a result or of another column
    void begin(const PointReader& reader);
    /// Writes the rows of a block. \throws FileError  if standard output cannot be written
    void write(const PointBlock& block, double time_s);
    /// Writes the closing bracket of JSON.
    void end();

   private:
    void fill_piece(std::size_t piece);
    void append_csv(std::string& text, std::size_t point) const;
    void append_json(std::string& text, std::size_t point, std::vector<std::string_view>& cells) const;

    struct Piece {
        std::string text;
        std::vector<std::string_view> cells;
    };

    const SampleBuffers& samples_;
    Interpolation interpolation_;
    bool as_json_, has_times_;
    const PointReader* reader_ = nullptr;
    std::vector<std::string> json_keys_;  ///< keys of the file's columns
    const PointBlock* block_ = nullptr;
    double time_s_ = 0;
    bool has_rows_ = false;
    std::vector<Piece> pieces_;
    JobGraph graph_;
    std::shared_ptr<Executor> executor_;
    std::unique_ptr<GraphRun> run_;
};

}  // namespace pelagic::tools
