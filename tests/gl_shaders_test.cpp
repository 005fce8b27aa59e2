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
    std::vector<gl::ProgramFiles> all = {{"panel.vert.glsl", "panel.frag.glsl", ""}};
    for (const std::size_t tiles : {1, 2, 4})
        for (const bool multiview : {false, true})
            for (const gl::Shading shading : {gl::Shading::headset, gl::Shading::medium, gl::Shading::high})
                for (const gl::ProgramFiles& files : gl::sea_program_files(multiview, tiles, shading))
                    all.push_back(files);
    for (const char* pass : {"bloom_down.frag.glsl", "bloom_up.frag.glsl", "display.frag.glsl", "meter.frag.glsl"})
        all.push_back({"screen.vert.glsl", pass, ""});
    using gl::Surface;
    for (const Surface surface : {Surface::lake, Surface::coast, Surface::river, Surface::pond})
        for (const bool multiview : {false, true})
            for (const gl::ProgramFiles& files : gl::sea_program_files(multiview, 1, gl::Shading::high, surface))
                all.push_back(files);
    ASSERT_EQ(all.size(), 135u);
    for (const gl::ProgramFiles& files : all)
        EXPECT_EQ(refusal_of(files), "") << files.vertex << ", " << files.fragment << "\n" << files.defines;
}

// Foam has three tiers (gl/shaders/foam.glsl); programs are made of the last one.
TEST(Shaders, AreGlslAtEachTierOfShading) {
    for (const std::string tier : {"0", "1"})
        for (gl::ProgramFiles files : gl::sea_program_files(false, 3)) {
            files.defines += "#define SHADING " + tier + "\n";
            EXPECT_EQ(refusal_of(files), "") << files.fragment << ", tier " << tier;
        }
}

TEST(Shaders, OfHeadsetsTakeBothEyesInOnePass) {
    for (const gl::ProgramFiles& files : gl::sea_program_files(true, 4, gl::Shading::headset)) {
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
