// The node PelagicBuoy: follows the surface of a PelagicOcean.
#pragma once

#include "pelagic/contrib/godot4/ocean.hpp"

namespace pelagic::godot4 {

class Buoy final : public Node {
   public:
    explicit Buoy(Object* self) : Node(self, "PelagicBuoy"), ocean_(Value::path("..")) {}
    static NodeClass& description();
    void enter_tree() override;
    /// Moves the node to the surface above or below it. Reports a reason for which it cannot once.
    void process(double seconds) override;

   private:
    void follow();
    Value ocean_;
    double offset_m_ = 0;
    bool tilts_ = false;
};

}  // namespace pelagic::godot4
