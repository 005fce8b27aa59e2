#include "pelagic/tools/events/event_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>

#include "pelagic/simd/det_math.hpp"
#include "pelagic/tools/files/digest.hpp"
#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/meshes/hull_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/path_text.hpp"
#include "pelagic/tools/text/typed_number.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* a_file = "a CSV file whose first line names time,x,z,radius,height";

enum class Column { time, x, z, radius, height, velocity, heading, duration, length, mode, hull };

/// A column, the numbers that it may hold, and their description in errors.
struct ColumnRule {
    Column column;
    std::string_view name;
    bool is_needed;
    double min, max;
    const char* accepted;
};

constexpr std::array<ColumnRule, 11> rules = {{
    {Column::time, "time", true, -1e9, 1e9, "seconds in [-1e9, 1e9]"},
    {Column::x, "x", true, -1e8, 1e8, "metres in [-1e8, 1e8]"},
    {Column::z, "z", true, -1e8, 1e8, "metres in [-1e8, 1e8]"},
    {Column::radius, "radius", true, 0.001, 1000, "metres in [0.001, 1000]"},
    {Column::height, "height", true, -100, 100, "metres in [-100, 100]"},
    {Column::velocity, "velocity", false, -1000, 1000, "metres a second in [-1000, 1000]"},
    {Column::heading, "heading", false, -360, 360, "degrees in [-360, 360]"},
    {Column::duration, "duration", false, 0, EventFile::longest_s, "seconds in [0, 86400]"},
    {Column::length, "length", false, 0.001, 1000, "metres in [0.001, 1000], or 0 for what is round"},
    {Column::mode, "mode", false, 0, 0, "impulse, pressure, relaxation or foam"},
    {Column::hull, "hull", false, 0, 0, "an OBJ or glTF 2.0 file"},
}};

std::string names_of_columns() {
    std::string names;
    for (const ColumnRule& rule : rules) names.append(names.empty() ? "" : ", ").append(rule.name);
    return names;
}

class EventReader {
   public:
    EventReader(const std::string& name, EventFile& file) : name_(name), file_(file) {}

    void take_line(std::string_view line) {
        ++line_number_;
        // a byte order mark
        if (line_number_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
        line = trimmed(line);
        if (line.empty()) return;
        if (columns_.empty()) return take_header(line);
        const std::vector<std::string> cells = cells_in(line);
        if (cells.size() != columns_.size())
            reject("the number of columns", number_text(cells.size()),
                   number_text(columns_.size()) + ", as in the first line");
        if (file_.events.size() == EventFile::max_events)
            reject("the number of events", "more", "at most " + number_text(EventFile::max_events));
        take_row(cells);
    }

    bool has_header() const { return !columns_.empty(); }

   private:
    [[noreturn]] void reject(std::string_view what, const std::string& value, const std::string& accepted) const {
        constexpr std::size_t longest = 40;
        throw InputError(name_ + ":" + number_text(line_number_) + ": " +
                         invalid_value_message(std::string(what), value.substr(0, longest), accepted));
    }

    static std::vector<std::string> cells_in(std::string_view line) {
        std::vector<std::string> cells = split_at_commas(line);
        for (std::string& cell : cells) cell = std::string(trimmed(cell));
        return cells;
    }

    void take_header(std::string_view line) {
        for (const std::string& cell : cells_in(line)) {
            const auto* rule = std::find_if(rules.begin(), rules.end(), [&](auto& one) { return one.name == cell; });
            if (rule == rules.end())
                reject("a column's name", cell, names_of_columns() + "; the first line names columns");
            if (std::find(columns_.begin(), columns_.end(), rule) != columns_.end())
                reject("a column's name", cell, "each column once");
            columns_.push_back(rule);
        }
        for (const ColumnRule& rule : rules)
            if (rule.is_needed && std::find(columns_.begin(), columns_.end(), &rule) == columns_.end())
                reject("the first line", std::string(line),
                       "a column " + std::string(rule.name) + ": time, x, z, radius and height are needed");
    }

    double number(const ColumnRule& rule, const std::string& cell) const {
        const auto value = parse_number(cell);
        const bool is_round = value && *value == 0 && rule.column == Column::length;
        if (!value || !(is_round || (*value >= rule.min && *value <= rule.max)))
            reject(rule.name, cell, rule.accepted);
        return *value;
    }

    std::shared_ptr<const HullMesh> hull_of(const std::string& cell) {
        std::shared_ptr<const HullMesh>& hull = hulls_[cell];
        if (hull) return hull;
        if (hulls_.size() > EventFile::max_hulls)
            reject("the number of hulls", "more", "at most " + number_text(EventFile::max_hulls));
        const std::string option = name_ + ":" + number_text(line_number_) + ": hull";
        return hull = std::make_shared<const HullMesh>(
                   read_hull(option, path_of(name_).parent_path() / cell));
    }

    void take_row(const std::vector<std::string>& cells) {
        WaterEvent event;
        std::string hull;
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (columns_[i]->column == Column::hull) hull = cells[i];
        Disturbance& push = event.push;
        double velocity_mps = 0, heading_deg = 0;
        std::optional<Disturbance::Mode> mode;
        push.length_m = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const ColumnRule& rule = *columns_[i];
            if (rule.column == Column::mode) {
                if (cells[i].empty()) continue;
                mode = value_named<Disturbance::Mode>(cells[i]);
                if (!mode) reject(rule.name, cells[i], rule.accepted);
                continue;
            }
            if (rule.column == Column::hull) continue;
            const bool may_be_empty = !rule.is_needed || (rule.column == Column::radius && !hull.empty());
            if (may_be_empty && cells[i].empty()) continue;
            const double value = number(rule, cells[i]);
            switch (rule.column) {
                case Column::time: event.time_s = value; break;
                case Column::x: push.x_m = value; break;
                case Column::z: push.z_m = value; break;
                case Column::radius: push.radius_m = value; break;
                case Column::height: push.height_m = value; break;
                case Column::velocity: velocity_mps = value; break;
                case Column::heading: heading_deg = value; break;
                case Column::duration: event.duration_s = value; break;
                case Column::length: push.length_m = value; break;
                case Column::mode:
                case Column::hull: break;
            }
        }
        const bool lasts = event.duration_s > 0;
        if (velocity_mps != 0 && !lasts)
            reject("velocity", number_text(velocity_mps), "0, or a duration: what is pushed once doesn't move");
        push.mode = mode.value_or(lasts ? Disturbance::Mode::pressure : Disturbance::Mode::impulse);
        if (lasts && push.mode == Disturbance::Mode::impulse)
            reject("mode", "impulse", "pressure or relaxation with a duration: an impulse acts at once");
        if (!hull.empty()) {
            if (!lasts) reject("duration", number_text(event.duration_s), "above 0 with a hull");
            if (push.mode != Disturbance::Mode::pressure)
                reject("mode", std::string(name_of(push.mode)), "pressure with a hull");
            if (push.height_m >= 0)
                reject("height", number_text(push.height_m), "below 0 with a hull: minus its draught");
            event.hull = hull_of(hull);
        }
        if (push.length_m > 0)
            push.shape = Disturbance::Shape::hull;
        else
            push.length_m = push.radius_m;
        push.heading_rad = heading_deg * radians_per_degree;
        const det::SineCosine heading = det::sine_cosine_of_turns(heading_deg / 360);
        push.velocity_x_mps = velocity_mps * heading.cosine;
        push.velocity_z_mps = velocity_mps * heading.sine;
        file_.events.push_back(event);
    }

    const std::string& name_;
    EventFile& file_;
    std::vector<const ColumnRule*> columns_;
    std::map<std::string, std::shared_ptr<const HullMesh>> hulls_;  ///< by cell
    std::size_t line_number_ = 0;
};

}  // namespace

double EventFile::first_s() const {
    return std::min_element(events.begin(), events.end(),
                            [](const WaterEvent& one, const WaterEvent& other) { return one.time_s < other.time_s; })
        ->time_s;
}

EventFile parse_events(const std::string& name, std::string_view text) {
    EventFile file{.text = std::string(text), .digest = digest_of(text), .events = {}};
    EventReader reader(name, file);
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        reader.take_line(line);
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    if (file.events.empty())
        throw InputError(name + (reader.has_header() ? " holds no events, expected rows below its first line"
                                                     : std::string(" is empty, expected ") + a_file));
    return file;
}

std::shared_ptr<const EventFile> read_events(const std::string& file) {
    InputFile input("--events", path_of(file), a_file);
    return std::make_shared<const EventFile>(parse_events(input.name(), input.read_all(EventFile::max_bytes)));
}

}  // namespace pelagic::tools
