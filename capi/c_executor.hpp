// Definition of pelagic_executor.
#pragma once

#include <memory>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/pelagic.h"

struct pelagic_executor {
    std::shared_ptr<pelagic::Executor> executor;
};
