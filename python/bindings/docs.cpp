#include "pelagic/python/bindings/docs.hpp"

#include <stdexcept>
#include <string>
#include <string_view>

namespace pelagic::python {
namespace {

struct Doc {
    std::string_view name;
    const char* text;
};
constexpr Doc docs[] = {
#include "pelagic/generated/python_docs.inc"
};

}  // namespace

const char* doc_of(const char* name) {
    for (const Doc& doc : docs)
        if (doc.name == name) return doc.text;
    throw std::logic_error("_pelagic.pyi has no docstring of " + std::string(name));
}

}  // namespace pelagic::python
