// A window with an OpenGL ES 3.0 context, through GLFW.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pelagic/gl/functions.hpp"
#include "pelagic/viewer/pointer_drag.hpp"

struct GLFWwindow;

namespace pelagic::viewer {

class Window {
   public:
    /// Throws gl::GlError: what is missing, in GLFW's words and ours.
    Window(int width, int height, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool should_close() const;
    void close();
    /// Takes input.
    void poll();
    /// Shows what was drawn.
    void swap();
    /// Keys that went down during the last poll(), as GLFW numbers them; a short press between two slow frames too.
    const std::vector<int>& pressed_keys() const { return pressed_keys_; }
    /// Pixels that the pointer moved to the right and down with the left button held, during the last poll().
    glm::dvec2 dragged_px() const { return drag_.moved_px(); }

    /// In pixels; 0 while it is minimised.
    int width() const;
    int height() const;

    GLFWwindow* handle() const { return window_; }
    const gl::Functions& functions() const { return functions_; }
    /// For functions that the front end does not call itself.
    static gl::GetProcAddress get_proc_address();

   private:
    static Window& window_of(GLFWwindow* handle);

    GLFWwindow* window_ = nullptr;
    gl::Functions functions_;
    std::vector<int> pressed_keys_;
    PointerDrag drag_;
};

}  // namespace pelagic::viewer
