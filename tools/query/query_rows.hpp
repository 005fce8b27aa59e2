// Output of `pelagic query`: one row per point, as CSV or as JSON.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/water_kinematics.hpp"
#include "pelagic/tools/query/points_file.hpp"

namespace pelagic::tools {

/// Writes to standard output. \throws FileError  if that fails
void write_output(std::string_view text);

/// Results for a block of points, a column each.
class ResultColumns {
   public:
    static constexpr std::size_t max_values = 11;
    static constexpr std::size_t all_points = std::dynamic_extent;

    /// Returns the names of the values in the order of the columns. The column `converged`, if there is
    /// one, follows them.
    std::span<const char* const> names() const { return names_; }
    bool has_converged() const { return has_converged_; }

    void resize(std::size_t points);
    float value(std::size_t column, std::size_t point) const { return values_[column][point]; }
    bool converged(std::size_t point) const { return converged_[point] != 0; }

   protected:
    /// \param names  at most max_values
    ResultColumns(std::vector<const char*> names, bool has_converged)
        : names_(std::move(names)), has_converged_(has_converged), values_(names_.size()) {}

    std::vector<const char*> names_;
    bool has_converged_;
    std::vector<std::vector<float>> values_;
    std::vector<std::uint8_t> converged_;
};

/// Results of the queries of the surface.
class SampleBuffers : public ResultColumns {
   public:
    SampleBuffers(bool has_foam, bool has_depth);

    /// Returns the arrays of `count` points, by default of all.
    SurfaceSamples samples(std::size_t first = 0, std::size_t count = all_points);
    /// Returns the still-water depths over a shore in metres; empty without that column.
    std::span<float> depths() { return has_depth_ ? values_.back() : std::span<float>(); }

   private:
    bool has_foam_, has_depth_;
};

/// Results for points at any depth.
class WaterBuffers : public ResultColumns {
   public:
    WaterBuffers();

    /// Returns the arrays of `count` points.
    WaterSamples samples(std::size_t first, std::size_t count);
};

/// Formats blocks as text, several pieces in parallel, and writes them to standard output in order.
class RowWriter {
   public:
    /// \param results        results of the block that write() receives; must outlive the writer
    /// \param interpolation  name of the interpolation of the queries, which JSON rows contain
    /// \param has_times      true if rows begin with the time
    RowWriter(std::shared_ptr<Executor> executor, const ResultColumns& results, std::string_view interpolation,
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

    const ResultColumns& results_;
    std::string_view interpolation_;
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
