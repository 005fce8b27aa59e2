// The node PelagicHull: moves itself as a hull that floats in the water of a PelagicOcean.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/contrib/godot3/engine.hpp"
#include "pelagic/contrib/godot3/ocean_node.hpp"
#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/floating/hull.hpp"
#include "pelagic/floating/hull_mesh.hpp"

namespace pelagic::godot {

/// The node's axes are those of its mesh: x forward, y up, z to starboard. They need no conversion,
/// because the engine's axes are Pelagic's.
///
/// In an ocean with dynamic waves the hull makes a wake. The first step adds its pressure to the
/// waves. A hull that is launched, leaves the tree, or has other options or another ocean, removes
/// its pressure and begins a new wake; so does one that makes no step while the ocean advances by
/// longest_pause_s.
class HullNode final : public WakeMaker {
   public:
    static constexpr const char* class_name = "PelagicHull";

    static constexpr double longest_pause_s = 0.25;
    static constexpr double longest_step_s = 1;  ///< that Hull::step() takes

    explicit HullNode(Object* self) : self_(self) {}
    ~HullNode();
    HullNode(const HullNode&) = delete;  // an ocean may point to it
    HullNode& operator=(const HullNode&) = delete;

    /// Callback of the engine: steps the hull if it is playing. Reports a reason for which it
    /// cannot once, until a step succeeds.
    void physics_process(double seconds);
    /// Callback of the ocean: moves the pressure of the wake to the hull.
    void press(const Frame& frame) override;
    /// Callback of the ocean, and of the engine if the node leaves the tree: removes the pressure.
    void leave_waves() override;

    // ---- properties; functions throw std::invalid_argument for an invalid value, and change
    // ---- nothing then

    /// Reports an invalid value: prints a line and emits the signal `refused` with it.
    void reject(std::string_view line) const;

    const Value& ocean() const { return *ocean_; }
    void set_ocean(std::string_view path);
    const Value& mesh() const { return *mesh_; }
    /// \param mesh  a Mesh, which is read now, or null
    void set_mesh(const Variant& mesh);
    const HullOptions& options() const { return options_; }
    /// Changes the options before the next step. The hull keeps its pose and velocity.
    void set_options(const HullOptions& options);
    const HullInputs& inputs() const { return inputs_; }
    void set_inputs(const HullInputs& inputs);
    bool has_wake() const { return has_wake_; }
    void set_wake(bool wake) { has_wake_ = wake; }
    bool is_playing() const { return is_playing_; }
    void set_playing(bool playing) { is_playing_ = playing; }

    // ---- methods; they throw std::invalid_argument if there is no mesh, or no ocean where they
    // ---- need one, and change nothing then. All but launch() launch a hull that is not afloat.

    /// Puts the hull where the node is, upright and at rest in still water.
    void launch();
    /// Advances the hull, by at most 1 s, in the ocean's frame of time_s(), and moves the node.
    /// \returns whether the hull has advanced by all of the time
    bool step(double seconds);
    /// Moves hull, wake and node, after OceanNode::set_origin() by (-x_m, -z_m). Does nothing if the hull
    /// is not afloat.
    void shift(double x_m, double z_m);
    /// Returns mass, volume and draught, and whether the hull floats.
    std::unique_ptr<Table> info();
    /// Returns position and velocities of the centre of mass, and what the water did in the last
    /// step.
    std::unique_ptr<Table> state();
    /// Returns the bytes of FloatingBodies::save_state(), and with a wake 8 more for press().
    std::vector<std::uint8_t> save_state();
    /// Restores the state of a hull with equal mesh and options, and moves the node. Restore the
    /// ocean's dynamic waves first.
    void restore_state(std::span<const std::uint8_t> saved);

   private:
    /// A hull in the water, the only body of a set.
    using Afloat = std::unique_ptr<FloatingBodies>;
    static constexpr std::uint32_t number = 1;  ///< of the body

    OceanNode* ocean_or_null() const;
    OceanNode& needed_ocean() const;
    Hull needed_hull() const;
    /// \param waves  null for a hull without a wake
    Afloat afloat(const Hull& hull, const HullState& state, DynamicWaves* waves = nullptr) const;
    HullState launched(const Hull& hull) const;
    /// Launches the hull, or changes it to the mesh and options that were set.
    FloatingBodies& needed_afloat();
    /// Returns the ocean in whose waves the hull makes a wake, or null.
    OceanNode* ocean_of_wake(OceanNode* ocean) const;
    void use_waves_of(OceanNode* ocean, Afloat afloat);
    /// Returns what save_state() appended, and removes it from the bytes.
    static double unpressed_in(std::span<const std::uint8_t>& saved);
    /// Restores the saved bodies. \throws std::invalid_argument  for bodies of another node
    static void read(FloatingBodies& bodies, std::span<const std::uint8_t> saved);
    void report_once(const std::exception& error);
    void place();

    Object* self_;
    std::unique_ptr<Value> ocean_ = std::make_unique<Value>(Path("..").value());
    std::unique_ptr<Value> mesh_ = std::make_unique<Value>();
    std::optional<HullMesh> hull_mesh_;  ///< of mesh_
    HullOptions options_{.mass_kg = 1000};
    HullInputs inputs_;
    bool has_wake_ = true;
    bool is_playing_ = true;
    bool is_stale_ = false;  ///< afloat_ differs from the mesh and the options
    Afloat afloat_;
    OceanNode* waves_of_ = nullptr;  ///< the ocean that calls press()
    double unpressed_s_ = 0;  ///< of steps since the last press()
    std::optional<double> pressed_at_s_;  ///< time of the frame of the last press()
    std::string reported_;                ///< by physics_process()
};

}  // namespace pelagic::godot
