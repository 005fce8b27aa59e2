// A camera's light meter: what an image's parts are lit like, from the GPU.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pelagic/gl/exposure.hpp"
#include "pelagic/gl/render_target.hpp"

namespace pelagic::gl {

class LightMeter {
   public:
    static constexpr int columns = 128, rows = 72;

    /// \param gl  outlives it. Throws GlError.
    explicit LightMeter(const Functions& gl);
    ~LightMeter();
    LightMeter(const LightMeter&) = delete;
    LightMeter& operator=(const LightMeter&) = delete;

    /// columns x rows cells. Waits for the GPU. GL state is afterwards what it was, here and below.
    std::vector<MeteredCell> measure(const TexturePart& radiance);

    /// Does not wait: what it sees is there some frames later. Nothing happens while something is under way.
    void start(const TexturePart& radiance);
    /// Once, when the GPU has it.
    std::optional<std::vector<MeteredCell>> finished();

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
