// What a pelagic_executor is.
#pragma once

#include <memory>

#include "capi/pelagic/pelagic.h"
#include "jobs/executor.hpp"

struct pelagic_executor {
    std::shared_ptr<pelagic::Executor> executor;
};
