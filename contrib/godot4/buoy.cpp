#include "pelagic/contrib/godot4/buoy.hpp"

#include <cmath>

namespace pelagic::godot4 {
namespace {

constexpr Option offset_option{"offset_m", Kind::real, 0, -1000, 1000, false, none, 1, "[-1000, 1000]", ""};
constexpr int after_ocean = -900;

}  // namespace

void Buoy::enter_tree() { self().call("set_process_priority", after_ocean); }

void Buoy::process(double) {
    run_in_frame([&] { follow(); });
}

void Buoy::follow() {
    Ocean& ocean = Ocean::at(self(), ocean_);
    Transform pose = self().call("get_global_transform").transform();
    Vector3 normal{};
    const float height = ocean.sample(pose.origin, tilts_ ? &normal : nullptr);
    pose.origin.y = height + static_cast<float>(offset_m_);
    if (tilts_) {
        // y along the normal; x in the vertical plane of the node's x axis, without its scale.
        const Vector3 bow{pose.row[0].x, pose.row[1].x, pose.row[2].x};
        const float along = bow.x * normal.x + bow.y * normal.y + bow.z * normal.z;
        Vector3 x{bow.x - along * normal.x, bow.y - along * normal.y, bow.z - along * normal.z};
        const float length = std::sqrt(x.x * x.x + x.y * x.y + x.z * x.z);
        if (length > 1e-6f) {
            x = {x.x / length, x.y / length, x.z / length};
            const Vector3 z{x.y * normal.z - x.z * normal.y, x.z * normal.x - x.x * normal.z,
                            x.x * normal.y - x.y * normal.x};
            pose.row[0] = {x.x, normal.x, z.x};
            pose.row[1] = {x.y, normal.y, z.y};
            pose.row[2] = {x.z, normal.z, z.z};
        }
    }
    self().call("set_global_transform", pose);
}

NodeClass& Buoy::description() {
    static NodeClass all = [] {
        NodeClass of("PelagicBuoy", "Node3D", {"_enter_tree", "_process"},
                     [](Object* self) { return std::make_unique<Buoy>(self); });
        const auto buoy = [](Node& node) -> Buoy& { return static_cast<Buoy&>(node); };
        of.property(
            {"ocean", type_path, 0, "", ""}, [=](Node& node) { return buoy(node).ocean_; },
            [=](Node& node, const Value& value) { buoy(node).ocean_ = Value::path(value.text()); });
        of.property(
            {"offset_m", type_float, 0, "", ""}, [=](Node& node) { return Value(buoy(node).offset_m_); },
            [=](Node& node, const Value& value) {
                buoy(node).offset_m_ = value_of(offset_option, "offset_m", value);
            });
        of.property(
            {"tilts", type_bool, 0, "", ""}, [=](Node& node) { return Value(buoy(node).tilts_); },
            [=](Node& node, const Value& value) { buoy(node).tilts_ = value.boolean(); });
        of.method("follow", {}, type_nil,
                  [=](Node& node, std::span<const Value>) { return buoy(node).follow(), Value(); });
        return of;
    }();
    return all;
}

}  // namespace pelagic::godot4
