// Names that code blocks of pages use without declaring them, for tests/page_snippets_test.py.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "pelagic/analytic/analytic_surface.hpp"
#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/floating/hull_mesh.hpp"
#include "pelagic/gl/functions.hpp"
#include "pelagic/gl/sky/sky_baker.hpp"
#include "pelagic/gl/water/sea_pass.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/quadtree/camera.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/analytic_cascades.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/gerstner_input.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/shore.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_ray.hpp"

using namespace pelagic;

extern SeaState sea, calm, storm;
extern Ocean ocean;
extern FloatingBodies bodies;
extern double camera_x, camera_z;
extern const Frame& frame;
extern const SurfaceQuery& water;
extern AnalyticSea other_waves;
extern Camera camera;
extern gl::GetProcAddress get_proc_address;
extern glm::dvec3 head;
extern std::vector<glm::dvec3> vertices;
extern std::vector<HullMesh::Triangle> triangles;
extern std::vector<glm::dmat4> both_eyes;
extern std::vector<double> xs, zs;
extern std::vector<float> heights, ups, heave;
extern double t, now_s, time_s, real_s, saved_s, speed, tick_s, x, z;
extern int tick, width, height;
extern bool paused;
extern std::vector<std::uint8_t> waves, boats, drops;
extern std::array<std::array<std::uint64_t, SnapshotFoam::images>, 4> uploaded;

void engine_parallel_for(void* user, std::size_t count, void (*job)(void* work, std::size_t index), void* work);
void engine_run_soon(void* user, void (*task)(void* work), void* work);
void* engine_allocate(void* user, std::size_t bytes, std::size_t alignment);
void engine_release(void* user, void* memory, std::size_t bytes, std::size_t alignment);
bool running();
void draw(const Frame& frame);
template <class... Textures>
void upload(const Textures&...);
template <class... Arguments>
void place(const Arguments&...);
