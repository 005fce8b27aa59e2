// Which seas' waves are at hand: a few places, of which the one goes first that was not needed for longest.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pelagic/sim/cascades/pass.hpp"

namespace pelagic {

class SpectrumCache {
   public:
    /// Two seas for the tick in flight, two for the frame, which may lie in another change, and one that is put there meanwhile.
    static constexpr std::size_t places = 2 * passes + 1;

    /// Where a sea's waves are; none if they have to be baked.
    std::optional<std::size_t> find(std::size_t number) const {
        for (std::size_t place = 0; place < places; ++place)
            if (held_[place] && held_[place]->number == number) return place;
        return {};
    }
    bool holds(std::size_t number) const { return find(number).has_value(); }

    /// The next run of the pass takes these; what an earlier one took may go.
    void need(Pass pass, std::size_t before, std::size_t after) {
        needed_[pass] = {before, after};
        ++now_;
        for (const std::size_t number : needed_[pass])
            if (const auto place = find(number)) held_[*place]->used = now_;
    }

    /// Whatever was taken is done.
    void need_nothing() { needed_ = nothing; }
    bool needs_any() const { return needed_.values != nothing.values; }

    /// A place for a sea that the cache doesn't hold. What was there is given up; no pass needs it.
    std::size_t put(std::size_t number) {
        std::size_t best = places;
        std::uint64_t oldest = ~std::uint64_t{0};
        for (std::size_t place = 0; place < places; ++place) {
            const std::uint64_t used = !held_[place]                     ? 0
                                       : is_needed(held_[place]->number) ? oldest
                                                                         : held_[place]->used;
            if (used >= oldest) continue;
            best = place;
            oldest = used;
        }
        assert(best < places && "passes need all places");
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

    std::array<std::optional<Held>, places> held_;
    static constexpr std::size_t none = ~std::size_t{0};
    static constexpr OfEachPass<std::array<std::size_t, 2>> nothing{{{{none, none}, {none, none}}}};
    OfEachPass<std::array<std::size_t, 2>> needed_ = nothing;
    std::uint64_t now_ = 0;
};

}  // namespace pelagic
