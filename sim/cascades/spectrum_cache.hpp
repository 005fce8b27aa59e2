// Numbers of the seas whose baked waves are in memory: a few entries, replaced in
// least-recently-used order.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pelagic/sim/buffers/pass.hpp"

namespace pelagic {

class SpectrumCache {
   public:
    /// Two seas for the tick in flight, two for the frame (which may be in another transition), and
    /// one that is put during the run.
    static constexpr std::size_t entries = 2 * passes + 1;

    /// Returns the entry of a sea's waves; empty if they are not in the cache.
    std::optional<std::size_t> find(std::size_t number) const {
        for (std::size_t entry = 0; entry < entries; ++entry)
            if (held_[entry] && held_[entry]->number == number) return entry;
        return {};
    }
    bool holds(std::size_t number) const { return find(number).has_value(); }

    /// Marks the seas that the next run of the pass reads, and releases those of its last run.
    void need(Pass pass, std::size_t before, std::size_t after) {
        needed_[pass] = {before, after};
        ++now_;
        for (const std::size_t number : needed_[pass])
            if (const auto entry = find(number)) held_[*entry]->used = now_;
    }

    /// Releases the seas of all passes.
    void need_nothing() { needed_ = nothing; }
    bool needs_any() const { return needed_.values != nothing.values; }

    /// Returns an entry for a sea, and evicts the sea that was in it.
    /// \pre the cache does not hold the sea, and some entry holds no sea that a pass needs
    std::size_t put(std::size_t number) {
        std::size_t best = entries;
        std::uint64_t oldest = ~std::uint64_t{0};
        for (std::size_t entry = 0; entry < entries; ++entry) {
            const std::uint64_t used = !held_[entry]                     ? 0
                                       : is_needed(held_[entry]->number) ? oldest
                                                                         : held_[entry]->used;
            if (used >= oldest) continue;
            best = entry;
            oldest = used;
        }
        assert(best < entries && "passes need all entries");
        held_[best] = {number, ++now_};
        return best;
    }

    void clear() { *this = {}; }

   private:
    struct Held {
        std::size_t number;
        std::uint64_t used;
    };
    bool is_needed(std::size_t number) const {
        for (const Pass pass : {Pass::tick, Pass::frame})
            for (const std::size_t needed : needed_[pass])
                if (needed == number) return true;
        return false;
    }

    std::array<std::optional<Held>, entries> held_;
    static constexpr std::size_t none = ~std::size_t{0};
    static constexpr OfEachPass<std::array<std::size_t, 2>> nothing{{{{none, none}, {none, none}}}};
    OfEachPass<std::array<std::size_t, 2>> needed_ = nothing;
    std::uint64_t now_ = 0;
};

}  // namespace pelagic
