// A camera's light meter: computes the luminance of the cells of an image on the GPU.
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

    /// \param gl  must outlive this object
    /// \throws GlError if the driver rejects a shader or cannot render to half floats
    explicit LightMeter(const Functions& gl);
    ~LightMeter();
    LightMeter(const LightMeter&) = delete;
    LightMeter& operator=(const LightMeter&) = delete;

    /// Measures columns x rows cells. Waits for the GPU. Restores the GL state.
    std::vector<MeteredCell> measure(const TexturePart& radiance);

    /// Starts a measurement without waiting; its result is available some frames later. Has no
    /// effect while a measurement is in progress. Restores the GL state.
    void start(const TexturePart& radiance);
    /// Returns the cells of a completed measurement, once. Returns nothing if no measurement was
    /// started or the GPU has not completed it. Restores the GL state.
    /// \pre Functions::maps_buffers
    std::optional<std::vector<MeteredCell>> finished();

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic::gl
