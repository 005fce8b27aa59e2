// Rendering in an application's EGL context: the application creates a context and a framebuffer,
// and Pelagic draws the sea into the framebuffer. Writes the last frame to sea.ppm. An engine or a
// headset's runtime provides context and framebuffer, and needs only the code from "The sea" on.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "pelagic/gl/water/sea_pass.hpp"
#include "pelagic/sim/ocean.hpp"

namespace {

constexpr int width = 960, height = 540;

[[noreturn]] void give_up(const char* what) {
    std::fprintf(stderr, "gl_application: %s; Debian: apt install libegl1 libgl1-mesa-dri\n", what);
    std::exit(1);
}

void make_context() {
    const auto get_platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    EGLDisplay display = get_platform_display ? get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr)
                                              : eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (!eglInitialize(display, nullptr, nullptr)) give_up("no EGL display");
    eglBindAPI(EGL_OPENGL_ES_API);
    const EGLint wishes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, wishes, &config, 1, &count) || count == 0) give_up("no OpenGL ES 3");
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) give_up("no context");
}

void make_framebuffer() {
    GLuint colour = 0, depth = 0, framebuffer = 0;
    glGenRenderbuffers(1, &colour);
    glBindRenderbuffer(GL_RENDERBUFFER, colour);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
}

void write_image() {
    std::vector<unsigned char> pixels(4 * width * height);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    std::FILE* file = std::fopen("sea.ppm", "wb");
    if (!file) give_up("can't write sea.ppm");
    std::fprintf(file, "P6\n%d %d\n255\n", width, height);
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x) std::fwrite(&pixels[4 * static_cast<std::size_t>(y * width + x)], 1, 3, file);
    std::fclose(file);
}

}  // namespace

int main() {
    make_context();
    make_framebuffer();

    // The sea.
    using namespace pelagic;
    const gl::Functions functions =
        gl::load_functions([](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); });
    Ocean ocean({.wind_speed_mps = 9}, {.queries = true, .foam = true});
    gl::SeaPass pass(functions, {.resolution = ocean.resolution(), .cascades = ocean.cascade_count()},
                     quadtree_preset_named("medium")->options(2048), gl::CausticsBaking::while_drawn);
    gl::SkyBaker baker(make_default_executor(), 128);
    baker.schedule({.sun_elevation_rad = 0.5f});
    pass.renderer().set_sky(baker.complete());

    ocean.schedule(0, pass.renderer().map_textures());
    for (int n = 1; n <= 3; ++n) {
        // The frame was scheduled one frame ago. Its textures are in a pixel buffer, except foam.
        pass.upload(ocean.complete());
        // Other threads compute the next frame while this thread draws.
        ocean.schedule(n / 72.0, pass.renderer().map_textures());

        const gl::Eye eye = gl::eye_of({.position_m = {0, 6, 0}, .target_m = {60, 0, 40}}, {0, 0, width, height});
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        pass.draw({.eyes = {&eye, 1}});
    }
    write_image();
}
