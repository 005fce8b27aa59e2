#include "pelagic/tools/record/record_file.hpp"

#include <istream>
#include <optional>
#include <streambuf>
#include <utility>
#include <vector>

#include "pelagic/tools/export/shard.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* frames_key = "frames";

/// Size limit of the head and of a frame. The options of an export with a million keys are smaller.
constexpr std::size_t max_element_bytes = std::size_t{64} << 20;

/// Limit of nested objects and lists, not counting the list of frames. Records have five levels.
constexpr std::size_t max_nested_levels = 8;

/// Reads the file piece by piece. Throws DamagedRecord if the head or a frame exceeds the size
/// limit.
class FilePieces : public std::streambuf {
   public:
    FilePieces(const OutputFolder& folder, const std::string& name, const Descriptor& file)
        : folder_(folder), name_(name), file_(file), piece_(std::size_t{1} << 18, '\0') {}

    void begin_element() { element_bytes_ = 0; }

   protected:
    int_type underflow() override {
        const std::size_t got = folder_.read_some(name_, file_, piece_);
        element_bytes_ += got;
        if (element_bytes_ > max_element_bytes) throw DamagedRecord();
        setg(piece_.data(), piece_.data(), piece_.data() + got);
        return got == 0 ? traits_type::eof() : traits_type::to_int_type(piece_[0]);
    }

   private:
    const OutputFolder& folder_;
    const std::string& name_;
    const Descriptor& file_;
    std::string piece_;
    std::size_t element_bytes_ = 0;
};

/// Builds the head and then each frame from parser events.
class RecordParser : public nlohmann::json_sax<ReadJson> {
   public:
    RecordParser(const RecordTaker& take, FilePieces& pieces) : take_(take), pieces_(pieces) {}

    bool is_stopped() const { return is_stopped_; }
    bool is_whole() const { return stage_ == Stage::behind_frames && open_.empty(); }

    bool null() override { return place(nullptr); }
    bool boolean(bool value) override { return place(value); }
    bool number_integer(number_integer_t value) override { return place(value); }
    bool number_unsigned(number_unsigned_t value) override { return place(value); }
    bool number_float(number_float_t value, const string_t&) override { return place(value); }
    bool string(string_t& value) override { return place(std::move(value)); }
    bool binary(binary_t&) override { return false; }
    bool key(string_t& key) override {
        key_ = std::move(key);
        return stage_ != Stage::behind_frames;
    }
    bool start_object(std::size_t) override { return begin(ReadJson::object()); }
    bool start_array(std::size_t) override {
        const bool is_list_of_frames = stage_ == Stage::head && open_.size() == 1 && key_ == frames_key;
        if (!is_list_of_frames) return begin(ReadJson::array());
        stage_ = Stage::frames;
        open_.clear();
        return goes_on(take_.head(element_));
    }
    bool end_object() override { return end(); }
    bool end_array() override {
        if (stage_ != Stage::frames || !open_.empty()) return end();
        stage_ = Stage::behind_frames;
        open_.push_back(&element_);
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

   private:
    enum class Stage { head, frames, behind_frames };

    bool goes_on(bool is_wanted) {
        is_stopped_ = !is_wanted;
        pieces_.begin_element();
        return is_wanted;
    }
    ReadJson* put(ReadJson&& value) {
        if (open_.empty()) return &(element_ = std::move(value));
        ReadJson& around = *open_.back();
        if (around.is_object()) return &(around[key_] = std::move(value));
        around.push_back(std::move(value));
        return &around.back();
    }
    bool place(ReadJson value) {
        put(std::move(value));
        return end_element();
    }
    bool begin(ReadJson&& value) {
        if (open_.size() == max_nested_levels) return false;
        open_.push_back(put(std::move(value)));
        return true;
    }
    bool end() {
        open_.pop_back();
        return end_element();
    }
    /// Passes a complete frame to the callback. A complete head without a list of frames is not a
    /// record.
    bool end_element() {
        if (!open_.empty() || stage_ == Stage::behind_frames) return true;
        return stage_ == Stage::frames && goes_on(take_.frame(element_));
    }

    const RecordTaker& take_;
    FilePieces& pieces_;
    Stage stage_ = Stage::head;
    bool is_stopped_ = false;
    ReadJson element_;             ///< the head, or a frame
    std::vector<ReadJson*> open_;  ///< open objects and lists of it, the outermost first
    std::string key_;
};

}  // namespace

void write_record(const OutputFolder& folder, const std::string& name, const Json& head,
                  const MakeFrames& make_frames, Json (*as_json)(const FrameRecord&)) {
    Json with_frames = head;
    with_frames[frames_key] = Json::array();
    const std::string text = with_frames.dump(2), end_of_list = "]\n}";
    folder.write(name, [&](const OutputFolder::Take& take) {
        std::string waiting = text.substr(0, text.size() - end_of_list.size());
        bool is_first = true;
        make_frames([&](const FrameRecord& frame) {
            waiting += (is_first ? "\n    " : ",\n    ") + as_json(frame).dump();
            is_first = false;
            constexpr std::size_t enough = 1 << 20;
            if (waiting.size() < enough) return;
            take(waiting);
            waiting.clear();
        });
        take(waiting + (is_first ? "" : "\n  ") + end_of_list + "\n");
    });
}

void write_finished(const OutputFolder& folder, const ExportOptions& options, double mean_significant_wave_height_m,
                    const std::vector<FileRecord>& sequence_files, const MakeFrames& make_frames) {
    write_record(folder, record_name({}), record_head(options, sequence_files), make_frames);
    write_record(folder, sea_json_name, sea_json_head(options, mean_significant_wave_height_m, sequence_files),
                 make_frames, frame_summary_as_json);
}

bool read_record(const OutputFolder& folder, const std::string& name, const RecordTaker& take) {
    const Descriptor file = folder.open_for_reading(name);
    if (!file.is_open()) return false;
    FilePieces pieces(folder, name, file);
    RecordParser parser(take, pieces);
    std::istream stream(&pieces);
    const bool is_parsed = ReadJson::sax_parse(stream, &parser);
    if (!parser.is_stopped() && !(is_parsed && parser.is_whole())) throw DamagedRecord();
    return true;
}

std::string read_frames(const OutputFolder& folder, const std::string& name, const ExportOptions& options,
                        Places places, const std::function<void(const ReadJson& head)>& head,
                        const std::function<void(std::size_t place, FrameRecord&& frame)>& take) {
    const std::vector<int> numbers = options.times.numbers(places.begin, places.end);
    std::size_t next = 0;
    std::string wrong;
    const auto check_head = [&](const ReadJson& json) {
        head(json);
        return true;
    };
    const auto take_entry = [&](const ReadJson& entry) {
        if (next == numbers.size()) {
            wrong = " has more than its " + std::to_string(numbers.size()) + " frames";
            return false;
        }
        std::optional<FrameRecord> frame = accepted_frame(entry, options);
        if (!frame || frame->frame != numbers[next]) {
            wrong = " does not say of frame " + std::to_string(numbers[next]) + " what an export writes of it";
            return false;
        }
        take(places.begin + next, std::move(*frame));
        ++next;
        return true;
    };
    try {
        if (!read_record(folder, name, {.head = check_head, .frame = take_entry})) return " is missing";
    } catch (const DamagedRecord&) {
        return " is damaged";
    }
    if (wrong.empty() && next < numbers.size())
        return " ends before frame " + std::to_string(numbers[next]) + ", of " + std::to_string(numbers.size()) +
               " frames";
    return wrong;
}

}  // namespace pelagic::tools
