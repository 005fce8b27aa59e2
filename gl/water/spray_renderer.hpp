// Draws droplets of spray as cards that face the eye, in one instanced draw call. SeaRenderer owns
// it.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/gl/objects.hpp"
#include "pelagic/gl/program.hpp"
#include "pelagic/gl/water/sea_programs.hpp"
#include "pelagic/sim/spray.hpp"

namespace pelagic::gl {

/// Returns the files of the program. \param soft  sprites fade at the surfaces of a depth texture
ProgramFiles spray_program_files(bool multiview, bool soft);

class SprayRenderer {
   public:
    /// \param gl  must outlive this object
    SprayRenderer(const Functions& gl, bool multiview);

    /// Uploads droplets for the next draw() calls, without those that are too faint or small to show.
    /// \param time_s  of the droplets
    /// \param wind_mps  10 m above the sea
    /// \param viewer_m  origin of the shaders' positions
    void upload(std::span<const SprayDroplet> droplets, double time_s, double wind_mps, const glm::dvec3& viewer_m);
    /// Draws the droplets, blended over the framebuffer, in the order of the upload. The scene's
    /// uniform block, the sky and, with `soft`, the depth texture are bound; the depth test is on.
    /// \param sample_weight  weight of the sprites in the mean of a pixel's samples, one for all.
    ///     A sprite's alpha is its opacity, so it has no weight of its own.
    void draw(int eye, bool soft, float sample_weight);

   private:
    struct Instance {
        glm::vec4 place, motion;
        glm::vec2 origin;
    };
    struct Sprites {
        SeaProgram program;
        GLint sample_weight, gale;
    };
    Sprites& sprites(bool soft);

    const Functions& gl_;
    bool multiview_;
    std::array<std::optional<Sprites>, 2> sprites_;  ///< by `soft`; compiled at the first use
    VertexArray array_;
    Buffer instances_;
    Texture shreds_;
    std::vector<Instance> staged_;
    float gale_ = 0;  ///< 0 to 1
};

}  // namespace pelagic::gl
