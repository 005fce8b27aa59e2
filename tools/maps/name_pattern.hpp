// Name patterns of image sequences: "wave.####.exr", "wave.%04d.exr".
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pelagic::tools {

/// A file name with a frame number: "wave." 0007 ".exr".
class NamePattern {
   public:
    /// Parses a pattern. The text must have exactly one number field, `#`s or `%0Nd` or `%d`,
    /// directly before an extension of letters and digits. It must be a valid file name: printable
    /// ASCII, not hidden, without a folder, at most 100 characters. Otherwise returns no pattern.
    static std::optional<NamePattern> parse(std::string_view text);

    /// Returns true if a text contains # or %, so that it is a pattern and not a folder.
    static bool is_meant(std::string_view text);

    /// Returns "wave.0007.exr", or with the mark "foam_c1" "wave.foam_c1.0007.exr".
    /// \param mark  identifies one of several images of a frame; may be empty
    std::string name(std::string_view mark, int frame, std::string_view extension) const;

    struct Parts {
        std::string_view mark, extension;
    };
    /// Returns the mark and the extension of a name that name() can return for some frame; else
    /// nothing.
    std::optional<Parts> parts_of(std::string_view name) const;

    const std::string& extension() const { return extension_; }
    /// Returns the pattern for records: "wave.####.exr".
    std::string text() const;

   private:
    std::string before_;      ///< "wave."
    std::size_t digits_ = 4;  ///< minimum number of digits
    std::string extension_;   ///< "exr"
};

}  // namespace pelagic::tools
