// The node PelagicOcean: a sea that follows the engine's clock, with checked properties, surface
// queries and rendering.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/contrib/godot3/engine.hpp"
#include "pelagic/contrib/godot3/sea_drawing.hpp"
#include "pelagic/contrib/godot3/settings.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::godot {

/// What makes a wake in the dynamic waves of an ocean. Its calls do not throw.
class WakeMaker {
   public:
    /// Moves the pressure of the wake, if what makes it has moved since the last call. The ocean
    /// calls it between complete() and schedule(). \param frame  the frame completed last
    virtual void press(const Frame& frame) = 0;
    /// Stops using the waves, which the ocean may destroy after the call.
    virtual void leave_waves() = 0;

   protected:
    ~WakeMaker() = default;
};

class OceanNode {
   public:
    static constexpr const char* class_name = "PelagicOcean";

    explicit OceanNode(Object* self);
    ~OceanNode();
    OceanNode(const OceanNode&) = delete;
    OceanNode& operator=(const OceanNode&) = delete;

    /// Returns the node of an object, or null if the object is no PelagicOcean.
    static OceanNode* of(const Object* object);

    // ---- callbacks of the engine

    void enter_tree();
    void exit_tree();
    /// Displays the frame computed since the last call and schedules the next one.
    void process(double seconds);

    // ---- properties; an invalid value is reported in one line and does not change the property

    const OceanSettings& settings() const { return settings_; }
    /// Recreates the ocean before the next frame or query.
    void change(const std::function<void(OceanSettings&)>& change);
    /// Reports an invalid value: prints a line and emits the signal `refused` with it.
    void reject(std::string_view line) const;

    double time_s() const { return time_s_; }
    void set_time(double time_s);
    bool is_playing() const { return is_playing_; }
    const WaterFrame& water_frame() const { return water_frame_; }
    /// Sets the sea level and the current from the next frame on.
    void set_water_frame(const WaterFrame& water);
    /// Shifts the world's origin at once: also of the frame of time_s(). Hull nodes are shifted by
    /// HullNode::shift(). \throws std::invalid_argument  out of range
    void set_origin(double x_m, double z_m);
    void set_playing(bool playing) { is_playing_ = playing; }
    const Value& material() const { return *material_; }
    void set_material(const Variant& material);

    // ---- queries of the frame of time_s(); empty results if the sea's options are invalid

    std::optional<std::uint64_t> hash();
    /// Returns the frame of time_s(), valid until the next call of a non-const function. Null if
    /// the sea's options are invalid.
    const Frame* frame();
    std::optional<float> height_at(const Vector3& place);
    /// Returns arrays with one element per position: height, normal, velocity if the node has
    /// velocities, and depth if it has a shore.
    std::unique_ptr<Table> query(std::span<const Vector3> places);
    /// Returns arrays with one element per position: depth, pressure, velocity and acceleration of the
    /// water there. Throws std::invalid_argument without the property `depth`, and below the sea floor.
    std::unique_ptr<Table> sample_water(std::span<const Vector3> places);
    /// Returns hit, distance, position and normal.
    std::unique_ptr<Table> first_hit(const Vector3& origin, const Vector3& direction, double reach_m);
    /// Returns the model's significant wave height in metres.
    std::optional<double> significant_wave_height_m();

    // ---- dynamic waves

    /// Returns the dynamic waves, whose commands take effect in the next frame that is scheduled.
    /// Null if the sea's options are invalid, which are reported then.
    /// \throws std::invalid_argument  if they are not enabled
    DynamicWaves* dynamic_waves();
    /// As dynamic_waves(), with no frame in flight, which saving and restoring require.
    DynamicWaves* dynamic_waves_between_frames();
    /// Returns the dynamic waves, or null if they are not enabled or the sea's options are invalid,
    /// which are reported then.
    DynamicWaves* dynamic_waves_or_null();
    /// Restores a saved state of the dynamic waves. The frame that is scheduled next is to have the
    /// time of the saved one: no wake is moved before it.
    void restore_dynamic_waves(std::span<const std::uint8_t> saved);
    /// Calls `wake` before each frame that is scheduled, until it is removed or has left the waves.
    /// \pre the dynamic waves are enabled
    void add(WakeMaker& wake) { wakes_.push_back(&wake); }
    void remove(WakeMaker& wake) { std::erase(wakes_, &wake); }
    /// Returns the hash of the dynamic waves of the frame of time_s().
    /// \throws std::invalid_argument  if they are not enabled
    std::optional<std::uint64_t> dynamic_waves_hash();

    // ---- spray

    /// Returns the ocean, whose spray's commands take effect in the next frame that is scheduled.
    /// Null if the sea's options are invalid, which are reported then.
    /// \throws std::invalid_argument  if spray is not enabled
    Ocean* ocean_with_spray();
    /// As ocean_with_spray(), with no frame in flight.
    Ocean* ocean_with_spray_between_frames();
    /// Sets the centre of the spray of crests, also of later oceans.
    void set_spray_center(const Vector3& place);
    /// Returns arrays with one element per droplet of the frame of time_s(): position, velocity,
    /// radius, opacity and age. \throws std::invalid_argument  if spray is not enabled
    std::unique_ptr<Table> droplets();
    /// \throws std::invalid_argument  if spray is not enabled
    std::optional<std::uint64_t> spray_hash();

   private:
    std::string invalid_options(const SeaState& sea) const;
    bool make_ocean();
    void start(double time_s);
    void place(Frame& frame) const;
    void move_wakes();
    void end_wakes();
    void draw(const Frame& frame);
    SurfaceQueryOptions query_options() const;

    Object* self_;
    OceanSettings settings_;
    std::unique_ptr<Ocean> ocean_;
    bool is_stale_ = true;            ///< the ocean differs from settings_
    bool has_dynamic_waves_ = false;  ///< of the ocean
    bool has_spray_ = false;          ///< of the ocean
    Vector3 spray_center_{};
    double time_s_ = 0;
    WaterFrame water_frame_;  ///< with the origin
    bool is_playing_ = true;
    std::optional<Frame> frame_;  ///< its droplets have the origin of its schedule
    WaterFrame scheduled_;        ///< of frame_, as it was scheduled
    bool is_awaited_ = true;           ///< frame_ is older than time_s_
    std::optional<double> in_flight_;  ///< time of the scheduled frame
    std::vector<WakeMaker*> wakes_;
    bool is_restored_ = false;  ///< the dynamic waves, since the last frame was scheduled
    std::unique_ptr<Value> material_ = std::make_unique<Value>();
    std::unique_ptr<SeaDrawing> drawing_;
    std::vector<double> x_, z_;
};

}  // namespace pelagic::godot
