#include "pelagic/web/bindings/errors.hpp"

#include <emscripten.h>

// clang-format off
EM_JS(void, pelagic_throw_error, (const char* message), {
    throw new Error(UTF8ToString(message));
});
// clang-format on

namespace pelagic::web {

void throw_error(const char* message) {
    pelagic_throw_error(message);
    __builtin_unreachable();
}

}  // namespace pelagic::web
