// The node PelagicOcean: a sea with the engine's clock, properties that are checked, answers about its surface, and its drawing.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "pelagic/examples/godot/engine.hpp"
#include "pelagic/examples/godot/sea_drawing.hpp"
#include "pelagic/examples/godot/settings.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::godot {

class OceanNode {
   public:
    explicit OceanNode(Object* self) : self_(self) {}

    // ---- what the engine calls

    void enter_tree();
    void exit_tree();
    /// Shows the frame that was computed since the last call, and starts the next one.
    void process(double seconds);

    // ---- properties; what can't be taken is refused in one line, and the old value stays

    const OceanSettings& settings() const { return settings_; }
    /// The sea is made anew before the next frame or answer.
    void change(const std::function<void(OceanSettings&)>& change);
    /// Says why a value is not taken: a line in the output, and the signal `refused` with it.
    void reject(std::string_view line) const;

    double time_s() const { return time_s_; }
    void set_time(double time_s);
    bool is_playing() const { return is_playing_; }
    void set_playing(bool playing) { is_playing_ = playing; }
    const Value& material() const { return *material_; }
    void set_material(const Variant& material);

    // ---- answers, about the frame of time_s(); nothing if there can be no such sea

    std::optional<std::uint64_t> hash();
    std::optional<float> height_at(const Vector3& place);
    /// Arrays as long as the places: height, normal, and velocity where the node has velocities.
    std::unique_ptr<Table> query(std::span<const Vector3> places);
    /// hit, distance, position, normal.
    std::unique_ptr<Table> first_hit(const Vector3& origin, const Vector3& direction, double reach_m);
    /// Significant wave height of the model, metres.
    std::optional<double> significant_wave_height_m();

   private:
    bool make_ocean();
    void start(double time_s);
    /// The frame of time_s_; null if there is no sea.
    const Frame* frame();
    void draw(const Frame& frame);
    SurfaceQuery query_of(const Frame& frame) const;

    Object* self_;
    OceanSettings settings_;
    std::unique_ptr<Ocean> ocean_;
    bool is_stale_ = true;  ///< the ocean is another than settings_ want
    double time_s_ = 0;
    bool is_playing_ = true;
    std::optional<Frame> frame_;
    bool is_awaited_ = true;           ///< frame_ is not yet that of time_s_
    std::optional<double> in_flight_;  ///< of which time
    std::unique_ptr<Value> material_ = std::make_unique<Value>();
    std::unique_ptr<SeaDrawing> drawing_;
    std::vector<double> x_, z_;
};

}  // namespace pelagic::godot
