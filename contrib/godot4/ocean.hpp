// The node PelagicOcean: a sea of the C interface that follows the engine's clock.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/capi/pelagic.h"
#include "pelagic/contrib/godot4/node_class.hpp"

namespace pelagic::godot4 {

/// Throws what a failed function of the C interface reports.
inline void require(pelagic_status status) {
    if (status != PELAGIC_OK) throw std::invalid_argument(pelagic_last_error());
}

// Constants of Mesh.
inline constexpr int vertex_array = 0, index_array = 12, arrays_count = 13, primitive_triangles = 3;

/// The vector of three doubles.
inline Vector3 floats(const double* of) {
    return {static_cast<float>(of[0]), static_cast<float>(of[1]), static_cast<float>(of[2])};
}

/// What has bodies in an ocean.
class Swimmer {
   public:
    /// Moves the pressure of a wake. Called between a completed frame, of `time_s`, and the next one.
    virtual void press(double time_s) = 0;
    /// Destroys the bodies: the ocean is about to be destroyed.
    virtual void leave() = 0;

   protected:
    ~Swimmer() = default;
};

struct OceanSettings {
    std::string preset = "custom";
    pelagic_sea sea = pelagic_sea_make();
    pelagic_water_frame water = pelagic_water_frame_make();
    pelagic_dynamic_waves_options dynamic_waves = pelagic_dynamic_waves_options_make();
    pelagic_spray_options spray = pelagic_spray_options_make();
    pelagic_shore_options shore = pelagic_shore_options_make();
    std::vector<float> shore_heights_m;
    bool foam = true, velocities = false, depth = false, has_dynamic_waves = false, has_spray = false;
    int threads = 0, interpolation = PELAGIC_INTERPOLATION_LINEAR;
    double footprint_m = 0;
};

class Ocean final : public Node {
   public:
    explicit Ocean(Object* self);
    ~Ocean() override;

    /// Returns the node of an object, or null if the object is no PelagicOcean.
    static Ocean* of(const Object* object);
    /// Returns the node at a path from another node. Throws std::invalid_argument if it is no PelagicOcean.
    static Ocean& at(const Value& node, const Value& path);
    static NodeClass& description();

    void enter_tree() override;
    /// Shows the frame that was scheduled by the last call, and schedules the next one.
    void process(double seconds) override;

    const OceanSettings& settings() const { return settings_; }
    double time_s() const { return time_s_; }
    /// Completes the frame of time_s() if necessary. Throws std::invalid_argument if no sea has the options.
    const pelagic_frame& frame();
    pelagic_ocean* handle() const { return ocean_; }
    double origin_x_m() const { return origin_x_m_; }
    double origin_z_m() const { return origin_z_m_; }
    bool has_dynamic_waves() const { return has_dynamic_waves_; }
    void add(Swimmer& swimmer) { swimmers_.push_back(&swimmer); }
    void remove(Swimmer& swimmer) { std::erase(swimmers_, &swimmer); }
    /// Height and normal of the surface at a position.
    float sample(const Vector3& place, Vector3* normal = nullptr);

   private:
    template <class Change>
    void change(const Change& change) {
        change(settings_);
        is_stale_ = true;
    }
    void set_time(double time_s);
    void set_water(const pelagic_water_frame& water);
    void set_origin(double x_m, double z_m);
    void make();
    void destroy();
    void start(double time_s);
    void finish();
    pelagic_dynamic_waves* waves();
    void need_spray();
    Value hash(int kind);
    Value query(std::span<const Vector3> places);
    Value sample_water(std::span<const Vector3> places);
    Value first_hit(const Vector3& origin, const Vector3& direction, double reach_m);
    Value droplets();

    OceanSettings settings_;
    bool is_stale_ = true, has_dynamic_waves_ = false, has_spray_ = false, has_shore_ = false;
    pelagic_ocean* ocean_ = nullptr;
    pelagic_frame frame_{};
    double time_s_ = 0, origin_x_m_ = 0, origin_z_m_ = 0, spray_x_m_ = 0, spray_z_m_ = 0;
    bool is_playing_ = true;
    bool is_awaited_ = true;           ///< frame_ is older than time_s_
    bool is_restored_ = false;         ///< the dynamic waves, since the last frame was scheduled
    std::optional<double> in_flight_;  ///< time of the scheduled frame
    std::vector<Swimmer*> swimmers_;
};

/// Returns the state that a function of the C interface saves.
template <class Save, class Handle>
std::vector<std::uint8_t> saved(const Save& save, Handle* handle) {
    std::size_t count = 0;
    require(save(handle, nullptr, 0, &count));
    std::vector<std::uint8_t> bytes(count);
    require(save(handle, bytes.data(), bytes.size(), &count));
    return bytes;
}

}  // namespace pelagic::godot4
