// Every shader that the code can compose, by GLSL's reference compiler: also those of headsets, which no driver here takes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "pelagic/gl/sea_programs.hpp"

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

/// What the compiler says of a program; empty if it links.
std::string refusal_of(const gl::ProgramFiles& files) {
    const Folder folder;
    const auto vertex = folder / "shader.vert", fragment = folder / "shader.frag";
    std::ofstream(vertex) << gl::shader_source(files.vertex, files.defines);
    std::ofstream(fragment) << gl::shader_source(files.fragment, files.defines);
    // -l: links the two, so that what one hands out is what the other takes.
    FILE* const pipe =
        popen(("glslangValidator -l " + vertex.string() + " " + fragment.string() + " 2>&1").c_str(), "r");
    std::string said;
    for (int c; (c = std::fgetc(pipe)) != EOF;) said += static_cast<char>(c);
    const int status = pclose(pipe);
    if (WEXITSTATUS(status) == 127) return "no glslangValidator; Debian: glslang-tools";
    return status == 0 ? "" : said;
}

TEST(Shaders, AreGlslInEveryVariant) {
    using gl::Shading, gl::Surface;
    std::vector<gl::SeaVariant> variants;
    for (const std::size_t tiles : {1, 2, 4})
        for (const Shading shading : {Shading::headset, Shading::medium, Shading::high})
            for (const bool multiview : {false, true})
                for (const bool below : {false, true})
                    variants.push_back({.tiles = tiles, .shading = shading, .multiview = multiview, .below = below});
    for (const Surface surface : {Surface::lake, Surface::coast, Surface::river, Surface::pond})
        for (const Shading shading : {Shading::headset, Shading::high})
            for (const bool below : {false, true})
                variants.push_back({.shading = shading, .surface = surface, .multiview = below, .below = below});
    std::vector<gl::ProgramFiles> all = {{"panel.vert.glsl", "panel.frag.glsl", ""}};
    for (const gl::SeaVariant& variant : variants)
        for (const gl::ProgramFiles& files : gl::sea_program_files(variant)) all.push_back(files);
    for (const char* pass : {"bloom_down.frag.glsl", "bloom_up.frag.glsl", "display.frag.glsl", "meter.frag.glsl"})
        all.push_back({"screen.vert.glsl", pass, ""});
    ASSERT_EQ(all.size(), 265u);
    for (const gl::ProgramFiles& files : all)
        EXPECT_EQ(refusal_of(files), "") << files.vertex << ", " << files.fragment << "\n" << files.defines;
}

TEST(Shaders, OfHeadsetsTakeBothEyesInOnePass) {
    for (const gl::ProgramFiles& files :
         gl::sea_program_files({.tiles = 4, .shading = gl::Shading::headset, .multiview = true})) {
        EXPECT_NE(gl::shader_source(files.vertex, files.defines).find("num_views = 2"), std::string::npos);
        EXPECT_NE(gl::shader_source(files.vertex, files.defines).find("gl_ViewID_OVR"), std::string::npos);
    }
}

// The check itself: a compiler that takes everything would prove nothing.
TEST(Shaders, WithAMistakeAreRefused) {
    EXPECT_NE(
        refusal_of({"sea.vert.glsl", "sea.frag.glsl",
                    "#define TILES 1\n#define SHADING 2\n#define MULTIVIEW\n#define gl_ViewID_OVR eye_of_nobody\n"}),
        "");
}

}  // namespace
}  // namespace pelagic
