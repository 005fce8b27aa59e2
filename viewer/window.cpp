#include "pelagic/viewer/window.hpp"

#include <algorithm>
#include <cstddef>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "pelagic/gl/errors.hpp"

namespace pelagic::viewer {
namespace {

gl::GlError failure(const std::string& what) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    return gl::GlError(what + (reason ? std::string(": ") + reason : std::string()));
}

}  // namespace

Window::Window(int width, int height, const std::string& title) {
    if (!glfwInit())
        throw failure("no display to open a window on; needs X11 (DISPLAY is set there), or Debian's xvfb");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!window_) {
        const gl::GlError error = failure("no window with OpenGL ES 3.0; Debian: libegl1 libgles2 libgl1-mesa-dri");
        glfwTerminate();
        throw error;
    }
    glfwSetWindowUserPointer(window_, this);
    // Dear ImGui later sets its own callbacks, which call these.
    glfwSetKeyCallback(window_, [](GLFWwindow* handle, int key, int, int action, int) {
        if (action == GLFW_PRESS) window_of(handle).pressed_keys_.push_back(key);
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* handle, double x, double y) {
        window_of(handle).drag_.move_to({x, y});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* handle, int button, int action, int) {
        if (button == GLFW_MOUSE_BUTTON_LEFT) window_of(handle).drag_.set_button(action == GLFW_PRESS);
    });
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    try {
        functions_ = gl::load_functions(get_proc_address());
    } catch (...) {
        glfwDestroyWindow(window_);
        glfwTerminate();
        throw;
    }
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

Window& Window::window_of(GLFWwindow* handle) { return *static_cast<Window*>(glfwGetWindowUserPointer(handle)); }

bool Window::should_close() const { return glfwWindowShouldClose(window_) != 0; }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void Window::poll() {
    pressed_keys_.clear();
    drag_.clear();
    glfwPollEvents();
}
void Window::swap() { glfwSwapBuffers(window_); }

glm::ivec2 Window::size() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

std::vector<std::uint8_t> Window::read_pixels() const {
    const int width = size().x, height = size().y;
    const std::ptrdiff_t row = std::ptrdiff_t{4} * width;
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(row * height));
    functions_.PixelStorei(GL_PACK_ALIGNMENT, 4);
    functions_.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    for (auto top = pixels.begin(), bottom = pixels.end() - row; top < bottom; top += row, bottom -= row)
        std::swap_ranges(top, top + row, bottom);
    return pixels;
}

gl::GetProcAddress Window::get_proc_address() {
    return [](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); };
}

}  // namespace pelagic::viewer
