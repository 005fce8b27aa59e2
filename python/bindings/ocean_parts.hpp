// Optional parts of an ocean: dynamic waves, spray, a shore, wave inputs, floating hulls.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <vector>

#include "pelagic/python/bindings/frame_handle.hpp"
#include "pelagic/sim/shore.hpp"
#include "pelagic/sim/wave_input.hpp"

namespace pelagic::python {

/// Reads the options from the attributes of any object; None gives no options. Throws
/// std::invalid_argument and TypeError.
std::optional<DynamicWavesOptions> dynamic_waves_options_of(pybind11::handle options);
std::optional<ShoreOptions> shore_options_of(pybind11::handle options);
std::optional<SprayOptions> spray_options_of(pybind11::handle options);

/// A wave input and the ocean that owns it.
struct InputHandle {
    bool is_taken = false;
    std::weak_ptr<SharedOcean> ocean;

    virtual ~InputHandle() = default;
    virtual std::shared_ptr<WaveInput> input() const = 0;
};

/// The inputs of one new ocean. No other ocean can have them, unless the creation of this ocean
/// fails.
class TakenInputs {
   public:
    /// Throws TypeError if `inputs` is not a list of inputs, and std::invalid_argument if another
    /// ocean has an input.
    explicit TakenInputs(pybind11::handle inputs);
    ~TakenInputs();
    TakenInputs(const TakenInputs&) = delete;
    TakenInputs& operator=(const TakenInputs&) = delete;

    std::vector<std::shared_ptr<WaveInput>> inputs() const;
    void give_to(const std::shared_ptr<SharedOcean>& ocean);

   private:
    std::vector<std::shared_ptr<InputHandle>> handles_;
    bool are_given_ = false;
};

/// Each function adds classes, the checks of the options in _options.py, and properties.
void add_dynamic_waves(pybind11::module_& module, FrameClass& frame, OceanClass& ocean);
void add_shore(pybind11::module_& module, FrameClass& frame);
void add_spray(pybind11::module_& module, FrameClass& frame, OceanClass& ocean);
void add_inputs(pybind11::module_& module);
void add_hulls(pybind11::module_& module);

}  // namespace pelagic::python
