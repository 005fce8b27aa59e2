#include "pelagic/tools/export/mesh_sequences.hpp"

#include <optional>
#include <utility>

#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/mesh_files.hpp"
#include "pelagic/tools/meshes/gltf_file.hpp"
#include "pelagic/tools/meshes/mdd_file.hpp"

namespace pelagic::tools {
namespace {

class GlbOutput : public SequenceOutput {
   public:
    explicit GlbOutput(const ExportOptions& options) : options_(options) {}

    void add(std::size_t, const Frame& frame) override {
        const Mesh mesh = exported_mesh(frame, options_);
        if (file_)
            file_->add(mesh);
        else
            file_.emplace(mesh, options_.times.count());
    }
    std::vector<File> finish() override {
        const FrameTimes& times = options_.times;
        const double fps = times.fps.value_or(static_cast<double>(times.count()) / times.loop_period_s);
        std::vector<File> files;  // an initializer list would copy the bytes
        files.push_back({mesh_animation_name, file_->finish(fps, !times.fps)});
        file_.reset();
        return files;
    }

   private:
    const ExportOptions& options_;
    std::optional<GlbFile> file_;
};

class MddOutput : public SequenceOutput {
   public:
    explicit MddOutput(const ExportOptions& options) : options_(options) {
        const FrameTimes& times = options.times;
        std::vector<float> times_s;
        for (std::size_t i = 0; i < times.count(); ++i)
            times_s.push_back(static_cast<float>(times.time_of(times.number(i)) - times.time_of(times.number(0))));
        const auto row = static_cast<std::size_t>(options.meshes.patch.steps) + 1;
        bytes_.reserve(mdd_bytes(row * row, times.count()));
        append_mdd_header(bytes_, times_s, row * row);
    }

    void add(std::size_t, const Frame& frame) override { append_mdd_frame(bytes_, exported_mesh(frame, options_)); }
    std::vector<File> finish() override {
        std::vector<File> files;
        files.push_back({point_cache_name, std::move(bytes_)});
        return files;
    }

   private:
    const ExportOptions& options_;
    Bytes bytes_;
};

}  // namespace

std::vector<std::unique_ptr<SequenceOutput>> mesh_sequences(const ExportOptions& options) {
    std::vector<std::unique_ptr<SequenceOutput>> outputs;
    if (options.meshes.has(MeshFormat::gltf_animation)) outputs.push_back(std::make_unique<GlbOutput>(options));
    if (options.meshes.has(MeshFormat::mdd)) outputs.push_back(std::make_unique<MddOutput>(options));
    return outputs;
}

}  // namespace pelagic::tools
