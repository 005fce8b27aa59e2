#include "pelagic/tools/export/sequence_output.hpp"

#include <optional>
#include <utility>

#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/flipbook.hpp"
#include "pelagic/tools/export/mesh_files.hpp"
#include "pelagic/tools/meshes/gltf_file.hpp"
#include "pelagic/tools/meshes/mdd_file.hpp"

namespace pelagic::tools {
namespace {

class MeshSequences : public SequenceOutput {
   public:
    explicit MeshSequences(const ExportOptions& options) : options_(options) {
        if (!options.meshes.has(MeshFormat::mdd)) return;
        const FrameTimes& times = options.times;
        std::vector<float> times_s;
        for (std::size_t i = 0; i < times.count(); ++i)
            times_s.push_back(static_cast<float>(times.time_of(times.number(i)) - times.time_of(times.number(0))));
        const auto row = static_cast<std::size_t>(options.meshes.patch.steps) + 1;
        mdd_.reserve(mdd_bytes(row * row, times.count()));
        append_mdd_header(mdd_, times_s, row * row);
    }

    void add(std::size_t, const Frame& frame) override {
        const Mesh mesh = exported_mesh(frame, options_);
        if (glb_)
            glb_->add(mesh);
        else if (options_.meshes.has(MeshFormat::gltf_animation))
            glb_.emplace(mesh, options_.times.count());
        if (!mdd_.empty()) append_mdd_frame(mdd_, mesh);
    }
    std::vector<File> finish() override {
        const FrameTimes& times = options_.times;
        const double fps = times.fps.value_or(static_cast<double>(times.count()) / times.loop_period_s);
        std::vector<File> files;  // an initializer list would copy the bytes
        if (glb_) files.push_back({mesh_animation_name, glb_->finish(fps, !times.fps)});
        glb_.reset();
        if (!mdd_.empty()) files.push_back({point_cache_name, std::move(mdd_)});
        return files;
    }

   private:
    const ExportOptions& options_;
    std::optional<GlbFile> glb_;
    Bytes mdd_;
};

}  // namespace

std::vector<std::unique_ptr<SequenceOutput>> mesh_sequences(const ExportOptions& options) {
    std::vector<std::unique_ptr<SequenceOutput>> outputs;
    if (options.meshes.has(MeshFormat::gltf_animation) || options.meshes.has(MeshFormat::mdd))
        outputs.push_back(std::make_unique<MeshSequences>(options));
    return outputs;
}

std::vector<std::unique_ptr<SequenceOutput>> sequence_outputs(const ExportOptions& options) {
    std::vector<std::unique_ptr<SequenceOutput>> outputs = mesh_sequences(options);
    if (options.flipbook) outputs.push_back(flipbook(options));
    return outputs;
}

}  // namespace pelagic::tools
