// GLSL's reference compiler on every shader that the code can compose, including those of headsets,
// which no driver here supports.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/gl/water/sea_programs.hpp"
#include "pelagic/gl/water/spray_renderer.hpp"

namespace pelagic {
namespace {

class Folder {
   public:
    Folder() { mkdtemp(path_.data()); }
    ~Folder() { std::filesystem::remove_all(path_); }
    std::filesystem::path operator/(const char* name) const { return std::filesystem::path(path_) / name; }

   private:
    std::string path_ = (std::filesystem::temp_directory_path() / "pelagic_shaders_XXXXXX").string();
};

/// Returns the compiler's messages for a program; empty if it links.
std::string invalid_value_of(const gl::ProgramFiles& files) {
    const Folder folder;
    const auto vertex = folder / "shader.vert", fragment = folder / "shader.frag";
    std::ofstream(vertex) << gl::shader_source(files.vertex, files.defines);
    std::ofstream(fragment) << gl::shader_source(files.fragment, files.defines);
    // -l links the two stages, so that the outputs of one must match the inputs of the other.
    FILE* const pipe =
        popen(("glslangValidator -l " + vertex.string() + " " + fragment.string() + " 2>&1").c_str(), "r");
    std::string said;
    for (int c; (c = std::fgetc(pipe)) != EOF;) said += static_cast<char>(c);
    const int status = pclose(pipe);
    if (WEXITSTATUS(status) == 127) return "no glslangValidator; Debian: glslang-tools";
    return status == 0 ? "" : said;
}

TEST(Shaders, CompileInEveryVariant) {
    using gl::Shading, gl::Surface;
    std::vector<gl::SeaVariant> variants;
    for (const std::size_t cascades : {1, 4})
        for (const Shading shading : {Shading::headset, Shading::medium, Shading::high})
            for (const auto& [multiview, below] : {std::pair(false, false), {false, true}, {true, true}})
                variants.push_back(
                    {.cascades = cascades, .shading = shading, .multiview = multiview, .below = below});
    for (const Surface surface : {Surface::lake, Surface::coast, Surface::river, Surface::pond})
        for (const Shading shading : {Shading::headset, Shading::high})
            variants.push_back({.shading = shading, .surface = surface, .below = true});
    for (const bool below : {false, true}) variants.push_back({.cascades = 4, .below = below, .mirrors_scene = true});
    for (const std::size_t cascades : {1, 4})
        for (const Shading shading : {Shading::headset, Shading::medium, Shading::high})
            for (const bool below : {false, true})
                variants.push_back({.cascades = cascades, .shading = shading, .below = below, .shore = true});
    variants.push_back({.cascades = 4, .shading = Shading::headset, .multiview = true, .below = true, .shore = true});
    variants.push_back({.cascades = 4, .below = true, .mirrors_scene = true, .shore = true});
    for (const Surface surface : {Surface::open, Surface::pond})
        for (const Shading shading : {Shading::headset, Shading::medium, Shading::high})
            variants.push_back({.cascades = surface == Surface::open ? 4u : 1u,
                                .shading = shading,
                                .surface = surface,
                                .multiview = shading == Shading::headset,
                                .below = shading != Shading::medium,
                                .mirrors_scene = shading == Shading::high,
                                .dynamic_waves = true});
    for (const Shading shading : {Shading::headset, Shading::high})
        variants.push_back({.cascades = 4, .shading = shading, .below = true, .dynamic_waves = true, .shore = true});
    for (const Surface surface : {Surface::open, Surface::pond})
        variants.push_back({.cascades = surface == Surface::open ? 4u : 1u,
                            .surface = surface,
                            .below = surface == Surface::open,
                            .surface_data = true});
    std::vector<gl::ProgramFiles> all = {{"panel.vert.glsl", "panel.frag.glsl", ""},
                                         {"mesh.vert.glsl", "rock.frag.glsl", ""},
                                         {"mesh.vert.glsl", "boat.frag.glsl", ""}};
    for (const gl::SeaVariant& variant : variants)
        for (const gl::ProgramFiles& files : gl::sea_program_files(variant)) all.push_back(files);
    for (const gl::SeaVariant& variant :
         {gl::SeaVariant{.cascades = 4, .shading = Shading::headset, .multiview = true},
          gl::SeaVariant{.shading = Shading::high, .surface = Surface::river, .below = true},
          gl::SeaVariant{.cascades = 4, .below = true, .mirrors_scene = true, .dynamic_waves = true, .shore = true}})
        for (const std::size_t exclusions : {std::size_t{1}, gl::max_exclusions})
            all.push_back(gl::exclusion_program_files(variant, exclusions));
    for (const char* pass : {"bloom_down.frag.glsl", "bloom_up.frag.glsl", "display.frag.glsl", "meter.frag.glsl"})
        all.push_back({"screen.vert.glsl", pass, ""});
    for (const auto& [multiview, soft] : {std::pair(false, false), {false, true}, {true, false}})
        all.push_back(gl::spray_program_files(multiview, soft));
    ASSERT_EQ(all.size(), 276u);
    for (const gl::ProgramFiles& files : all)
        EXPECT_EQ(invalid_value_of(files), "") << files.vertex << ", " << files.fragment << "\n" << files.defines;
}

TEST(Shaders, OfHeadsetsDrawBothEyesInOnePass) {
    for (const gl::ProgramFiles& files :
         gl::sea_program_files({.cascades = 4, .shading = gl::Shading::headset, .multiview = true})) {
        EXPECT_NE(gl::shader_source(files.vertex, files.defines).find("num_views = 2"), std::string::npos);
        EXPECT_NE(gl::shader_source(files.vertex, files.defines).find("gl_ViewID_OVR"), std::string::npos);
    }
}

/// Returns the maximum cost of a pixel: all functions inlined into main, all loops unrolled, by
/// glslang and SPIR-V's optimiser.
struct PixelCost {
    int looks = 0, operations = 0, loops = 0;
};

PixelCost cost_of(const gl::ProgramFiles& files) {
    const Folder folder;
    std::string text = gl::shader_source(files.fragment, files.defines);
    const std::string version = "300 es";
    // the lowest version that SPIR-V supports
    text.replace(text.find(version), version.size(), "310 es");
    const auto shader = folder / "shader.frag", raw = folder / "raw.spv", marked = folder / "marked.spv";
    std::ofstream(shader) << text;
    const std::string command =
        "glslangValidator -G --auto-map-locations --auto-map-bindings -o " + raw.string() + " " + shader.string() +
        " >/dev/null && spirv-dis " + raw.string() +
        " | sed 's/\\(OpLoopMerge %[^ ]* %[^ ]*\\) None/\\1 Unroll/' | " + "spirv-as --target-env spv1.0 - -o " +
        marked.string() +
        " && spirv-opt --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions "
        "--eliminate-local-single-block --eliminate-local-single-store --ssa-rewrite --ccp --loop-unroll --ccp "
        "--eliminate-dead-branches --simplify-instructions --redundancy-elimination "
        "--eliminate-dead-code-aggressive " +
        marked.string() + " -o - | spirv-dis -";
    FILE* const pipe = popen(command.c_str(), "r");
    PixelCost cost;
    const auto has = [](const char* line, std::initializer_list<const char*> names) {
        return std::any_of(names.begin(), names.end(),
                           [&](const char* name) { return std::strstr(line, name) != nullptr; });
    };
    for (char line[4096]; std::fgets(line, sizeof line, pipe);) {
        cost.looks += has(line, {" OpImageSample"});
        cost.loops += has(line, {"OpLoopMerge"});
        cost.operations += has(line, {"OpFAdd", "OpFSub", "OpFMul", "OpFDiv", "OpFNegate", "OpDot", "OpVectorTimes",
                                      "OpMatrixTimes", " OpExtInst "});
    }
    EXPECT_EQ(pclose(pipe), 0) << "Debian: glslang-tools, spirv-tools";
    return cost;
}

// A pixel of the open sea; docs/rendering.md has the same table. On a headset it takes one texture
// sample for each of three cascades, two for their snapshots, and one each for the ripples, the
// structure of foam, the reflected sky and the haze.
// No loop remains that a driver might not unroll.
TEST(Shaders, StayWithinTheirTiersCostPerPixel) {
    using gl::Shading;
    struct Row {
        Shading shading;
        int looks_at_one_cascade, looks_at_four;
        int operations;  // with four cascades, approximately
    };
    for (const Row& row :
         {Row{Shading::headset, 7, 13, 1188}, Row{Shading::medium, 15, 29, 1718}, Row{Shading::high, 35, 52, 2155}}) {
        for (const std::size_t cascades : {1, 4}) {
            const PixelCost cost = cost_of(gl::sea_program_files({.cascades = cascades, .shading = row.shading})[0]);
            std::printf("%s, %zu cascades: %d look-ups, %d operations\n", std::string(name_of(row.shading)).c_str(),
                        cascades, cost.looks, cost.operations);
            EXPECT_EQ(cost.loops, 0);
            EXPECT_EQ(cost.looks, cascades == 1 ? row.looks_at_one_cascade : row.looks_at_four)
                << cascades << " cascades";
            const PixelCost with_window = cost_of(
                gl::sea_program_files({.cascades = cascades, .shading = row.shading, .dynamic_waves = true})[0]);
            std::printf("    and a dynamic-wave grid: %d look-ups, %d operations\n", with_window.looks,
                        with_window.operations);
            EXPECT_EQ(with_window.loops, 0);
            EXPECT_EQ(with_window.looks, cost.looks + 1);
            // Its position, four products, and the union of its foam with the cascades'.
            EXPECT_LE(with_window.operations, cost.operations + 45);
            if (row.shading == Shading::headset) {
                EXPECT_LE(cost.looks, 13);
            }
            // The count differs by some operations between versions of the optimiser.
            if (cascades == 4) {
                EXPECT_NEAR(cost.operations, row.operations, 0.1 * row.operations);
            }
        }
    }
}

// At a shore a pixel takes one texture sample of the cascades' weights and one of the waves, except
// that headsets take another for the waves' foam. This is about 80 operations: with four cascades a
// headset takes 15 texture samples there and nowhere else.
TEST(Shaders, TakeThreeMoreTextureSamplesAtAShore) {
    using gl::Shading;
    for (const Shading shading : {Shading::headset, Shading::medium, Shading::high}) {
        const PixelCost open = cost_of(gl::sea_program_files({.cascades = 4, .shading = shading})[0]);
        const PixelCost shore = cost_of(gl::sea_program_files({.cascades = 4, .shading = shading, .shore = true})[0]);
        std::printf("%s: %d more look-ups, %d more operations\n", std::string(name_of(shading)).c_str(),
                    shore.looks - open.looks, shore.operations - open.operations);
        EXPECT_EQ(shore.loops, 0);
        EXPECT_EQ(shore.looks, open.looks + (shading == Shading::headset ? 2 : 3));
        // The count differs by some operations between versions of the optimiser.
        EXPECT_LE(shore.operations, open.operations + 110);
    }
}

// A pixel of a patch that reaches the interior of a hull takes a texture sample, or two if there
// are more hulls, whose boxes may overlap. The text of all other programs does not depend on
// exclusions.
TEST(Shaders, TakeAtMostTwoSamplesForTheInteriorsOfHulls) {
    const gl::SeaVariant variant{.cascades = 4, .shading = gl::Shading::headset};
    const PixelCost plain = cost_of(gl::sea_program_files(variant)[0]);
    for (const std::size_t exclusions : {std::size_t{1}, gl::max_exclusions}) {
        const PixelCost excluding = cost_of(gl::exclusion_program_files(variant, exclusions));
        std::printf("%zu hulls: %d more look-ups, %d more operations\n", exclusions, excluding.looks - plain.looks,
                    excluding.operations - plain.operations);
        EXPECT_EQ(excluding.loops, 0);
        EXPECT_EQ(excluding.looks, plain.looks + (exclusions == 1 ? 1 : 2));
    }
    for (const gl::ProgramFiles& files : gl::sea_program_files(variant))
        EXPECT_EQ(files.defines.find("EXCLUSIONS"), std::string::npos);
}

// Checks the check itself: a compiler that accepts everything would prove nothing.
TEST(Shaders, WithAnErrorAreRejected) {
    EXPECT_NE(
        invalid_value_of(
            {"sea.vert.glsl", "sea.frag.glsl",
             "#define CASCADES 1\n#define SHADING 2\n#define MULTIVIEW\n#define gl_ViewID_OVR eye_of_nobody\n"}),
        "");
}

}  // namespace
}  // namespace pelagic
