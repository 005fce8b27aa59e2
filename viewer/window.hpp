// A window with an OpenGL ES 3.0 context, through GLFW.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pelagic/gl/functions.hpp"
#include "pelagic/viewer/pointer_drag.hpp"

struct GLFWwindow;

namespace pelagic::viewer {

class Window {
   public:
    /// Opens the window and makes its context current.
    /// \throws gl::GlError with the missing component and GLFW's message
    Window(int width, int height, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool should_close() const;
    void close();
    /// Processes input events.
    void poll();
    /// Swaps the window's buffers.
    void swap();
    /// Returns the GLFW key codes of all key presses of the last poll(), including short presses
    /// between two slow frames.
    const std::vector<int>& pressed_keys() const { return pressed_keys_; }
    /// Returns the pointer's movement to the right and down with the left button held, during the
    /// last poll(), pixels.
    glm::dvec2 dragged_px() const { return drag_.moved_px(); }

    /// Returns the size of the framebuffer, pixels; 0 while the window is minimised.
    glm::ivec2 size() const;

    /// Reads the framebuffer before swap(): RGBA8, top row first. Waits for the GPU.
    std::vector<std::uint8_t> read_pixels() const;

    GLFWwindow* handle() const { return window_; }
    const gl::Functions& functions() const { return functions_; }
    /// Returns the loader, for functions that gl::Functions does not contain.
    static gl::GetProcAddress get_proc_address();

   private:
    static Window& window_of(GLFWwindow* handle);

    GLFWwindow* window_ = nullptr;
    gl::Functions functions_;
    std::vector<int> pressed_keys_;
    PointerDrag drag_;
};

}  // namespace pelagic::viewer
