#include "pelagic/tests/openxr_runtime/record.hpp"

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

namespace pelagic::openxr_stand_in {
namespace {

using Json = nlohmann::json;

Json json_of(const XrPosef& pose) {
    const XrQuaternionf& q = pose.orientation;
    const XrVector3f& p = pose.position;
    return {{"x", p.x}, {"y", p.y}, {"z", p.z}, {"qx", q.x}, {"qy", q.y}, {"qz", q.z}, {"qw", q.w}};
}

Json json_of(const XrFovf& fov) {
    return {{"left", fov.angleLeft}, {"right", fov.angleRight}, {"up", fov.angleUp}, {"down", fov.angleDown}};
}

Json json_of(const Record::Eye& eye) {
    return {{"pose", json_of(eye.pose)},
            {"fov", json_of(eye.fov)},
            {"submitted_pose", json_of(eye.submitted_pose)},
            {"submitted_fov", json_of(eye.submitted_fov)}};
}

Json json_of(const Record::Frame& frame) {
    return {
        {"display_time_ns", frame.display_time_ns}, {"should_render", frame.should_render}, {"layers", frame.layers}};
}

void write_image(const std::string& file, const Record::Eye& eye) {
    std::ofstream to(file, std::ios::binary);
    to << "P6\n" << eye.width << ' ' << eye.height << "\n255\n";
    to.write(reinterpret_cast<const char*>(eye.rgb.data()), static_cast<std::streamsize>(eye.rgb.size()));
}

}  // namespace

void Record::write() const {
    const char* folder = std::getenv("PELAGIC_STAND_IN_FOLDER");
    if (!folder) return;
    Json all = {{"states", states},
                {"refusals", refusals},
                {"frames", Json::array()},
                {"last_display_time_ns", last_display_time_ns},
                {"eyes", {json_of(eyes[0]), json_of(eyes[1])}}};
    for (const Frame& frame : frames) all["frames"].push_back(json_of(frame));
    std::ofstream(std::string(folder) + "/record.json") << all.dump(1) << '\n';
    if (eyes[0].rgb.empty()) return;
    write_image(std::string(folder) + "/left.ppm", eyes[0]);
    write_image(std::string(folder) + "/right.ppm", eyes[1]);
}

}  // namespace pelagic::openxr_stand_in
