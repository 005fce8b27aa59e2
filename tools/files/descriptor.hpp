// An owned file descriptor; the destructor closes it.
#pragma once

#include <unistd.h>

#include <utility>

namespace pelagic::tools {

class Descriptor {
   public:
    Descriptor() = default;
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
    ~Descriptor() {
        if (is_open()) ::close(descriptor_);
    }
    Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }

    bool is_open() const { return descriptor_ >= 0; }
    int get() const { return descriptor_; }
    /// Gives up ownership: the caller closes the descriptor.
    int release() { return std::exchange(descriptor_, -1); }

   private:
    int descriptor_ = -1;
};

}  // namespace pelagic::tools
