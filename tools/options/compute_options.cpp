#include "pelagic/tools/options/compute_options.hpp"

#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* group = "Computing (results are bit-identical for all values)";

std::vector<std::string> names_of_isas_here() {
    std::vector<std::string> names;
    for (const Isa isa : isas_here()) names.emplace_back(name_of(isa));
    return names;
}

}  // namespace

void ComputeFlags::add_to(CLI::App& app) {
    app.add_option("--threads", threads_, "maximum number of threads; 0 to 1024, 0: one per core (default: 0)")
        ->type_name("NUMBER")
        ->group(group);
    const std::vector<std::string> isas = names_of_isas_here();
    app.add_option("--isa", isa_, "instruction set: " + list_of(isas) + " on this CPU (default: the strongest)")
        ->type_name("NAME")
        ->group(group);
}

ComputeOptions ComputeFlags::resolve() const {
    ComputeOptions options;
    if (threads_) options.threads = whole_number_in("--threads", *threads_, 0, 1024);
    if (isa_) {
        options.isa = isa_named(*isa_);
        const std::vector<std::string> here = names_of_isas_here();
        if (!options.isa || !runs_here(*options.isa)) throw bad_value("--isa", *isa_, list_of(here) + " on this CPU");
    }
    try {
        options.isa = choose_isa(options.isa);
    } catch (const std::invalid_argument& error) {
        throw InputError(error.what());
    }
    return options;
}

bool ComputeFlags::names_isa() const {
    const char* const variable = std::getenv("PELAGIC_ISA");
    return isa_ || (variable && *variable);
}

}  // namespace pelagic::tools
