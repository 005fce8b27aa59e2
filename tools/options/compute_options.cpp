#include "pelagic/tools/options/compute_options.hpp"

#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/progress.hpp"

namespace pelagic::tools {
namespace {

std::vector<std::string> names_of_isas_here() {
    std::vector<std::string> names;
    for (const Isa isa : isas_here()) names.emplace_back(name_of(isa));
    return names;
}

}  // namespace

void ComputeFlags::add_to(CLI::App& app) {
    app.add_option("--threads", threads_, "number of threads; 0 to 1024, 0: one per usable CPU (default: 0)")
        ->type_name("NUMBER")
        ->group(help_group::performance);
    app.add_option("--isa", isa_, "instruction set, if this CPU has it (default: the strongest)")
        ->type_name("sse4.2|avx2|avx512|neon")
        ->group(help_group::performance);
}

ComputeOptions ComputeFlags::resolve() const {
    ComputeOptions options;
    if (threads_) options.threads = whole_number_in("--threads", *threads_, 0, 1024);
    if (const int cpus = default_thread_count(); options.threads > cpus)
        print_note("--threads " + *threads_ + " is more than the CPUs that this process may use, " +
                   std::to_string(cpus) + ": uses as many");
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
