// The node PelagicHull: moves itself as a hull that floats in the water of a PelagicOcean.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/contrib/godot4/ocean.hpp"

namespace pelagic::godot4 {

/// The node's axes are those of its mesh: x forward, y up, z to starboard.
class Hull final : public Node, public Swimmer {
   public:
    explicit Hull(Object* self) : Node(self, "PelagicHull"), ocean_(Value::path("..")) { options_.mass_kg = 1000; }
    ~Hull() override;
    static NodeClass& description();

    void exit_tree() override;
    /// Steps the hull if it is playing. Reports a reason for which it cannot once, until a step succeeds.
    void physics_process(double seconds) override;
    void press(double time_s) override;
    void leave() override;

   private:
    static constexpr double longest_pause_s = 0.25;
    using Vector = std::array<double, 3>;
    void set_mesh(const Value& mesh);
    void set_options(const pelagic_hull_options& options, const std::optional<Vector>& centre,
                     const std::optional<Vector>& inertia);
    pelagic_hull* make(const pelagic_hull_options& options, const std::optional<Vector>& centre,
                       const std::optional<Vector>& inertia) const;
    pelagic_hull* needed_hull();
    void launch();
    void need_bodies(Ocean& ocean);
    bool step(double seconds);
    void shift(double x_m, double z_m);
    void place();
    Value info();
    Value state();
    Value save();
    void restore(const Value& saved);

    Value ocean_, mesh_;
    std::vector<double> vertices_m_;
    std::vector<std::uint32_t> triangles_;
    pelagic_hull_options options_ = pelagic_hull_options_make();
    std::optional<Vector> centre_of_mass_m_, inertia_kgm2_;
    pelagic_hull_inputs inputs_ = pelagic_hull_inputs_make();
    bool has_wake_ = true, is_playing_ = true;
    pelagic_hull* hull_ = nullptr;
    pelagic_hull_info info_{};                 ///< of hull_
    std::optional<pelagic_hull_state> state_;  ///< none: not launched
    pelagic_hull_loads loads_{};               ///< of the last step
    Ocean* swims_in_ = nullptr;                ///< the ocean of bodies_
    pelagic_bodies* bodies_ = nullptr;
    bool makes_wake_ = false;  ///< bodies_
    std::uint32_t number_ = 0;
    double unpressed_s_ = 0;              ///< of steps since the last press()
    std::optional<double> pressed_at_s_;  ///< time of the frame of the last press()
};

}  // namespace pelagic::godot4
