#include "pelagic/sim/texture_targets.hpp"

#include <string_view>

#include "pelagic/message/number_text.hpp"

namespace pelagic {
namespace {

bool is_multiple_of(std::size_t bytes, const void* address) {
    return reinterpret_cast<std::uintptr_t>(address) % bytes == 0;
}

std::string no_multiple_of(std::size_t bytes) { return "at an address that is no multiple of " + number_text(bytes); }

std::string check_chain(std::string_view name, const TextureTargets::Chain& chain, int levels, bool is_there,
                        std::string_view option) {
    bool is_wanted = false;
    for (const std::uint32_t* level : chain) is_wanted |= level != nullptr;
    if (!is_wanted) return {};
    if (!is_there)
        return std::string(name) + " is requested, but the ocean was created without " + std::string(option);
    for (int level = 0; level < levels; ++level) {
        const std::uint32_t* texels = chain[static_cast<std::size_t>(level)];
        if (!texels)
            return std::string(name) + " lacks level " + number_text(level) + ", expected " + number_text(levels) +
                   " levels";
        if (!is_multiple_of(alignof(std::uint32_t), texels))
            return "level " + number_text(level) + " of " + std::string(name) + " is " +
                   no_multiple_of(alignof(std::uint32_t));
    }
    return {};
}

std::string check_targets(const TextureTargets& targets, int resolution, const FrameContents& contents) {
    if (!is_multiple_of(TextureTargets::alignment, targets.displacement_rgba16f))
        return "displacement_rgba16f is " + no_multiple_of(TextureTargets::alignment);
    struct Chain {
        std::string_view name;
        const TextureTargets::Chain& levels;
        bool is_there;
        std::string_view option;
    };
    for (const Chain& chain : {Chain{"gradient_rgba8", targets.gradient_rgba8, contents.gradients, "gradients"},
                               Chain{"slopes_rgba8", targets.slopes_rgba8, contents.slopes, "slopes"},
                               Chain{"moments_rgba8", targets.moments_rgba8, contents.slopes, "slopes"}})
        if (std::string reason =
                check_chain(chain.name, chain.levels, mip_levels(resolution), chain.is_there, chain.option);
            !reason.empty())
            return reason;
    return {};
}

}  // namespace

TextureTargets::Chain chain_in(std::uint32_t* texels, int resolution) {
    TextureTargets::Chain chain{};
    for (int level = 0; level < mip_levels(resolution); ++level)
        chain[static_cast<std::size_t>(level)] = texels + mip_offset(resolution, level);
    return chain;
}

std::string check(std::span<const TextureTargets> cascades, std::size_t cascade_count, int resolution,
                  const FrameContents& contents) {
    if (cascades.size() != cascade_count)
        return "there are targets of " + number_text(cascades.size()) + " cascades, expected " +
               number_text(cascade_count);
    for (const TextureTargets& targets : cascades)
        if (std::string reason = check_targets(targets, resolution, contents); !reason.empty()) return reason;
    return {};
}

}  // namespace pelagic
