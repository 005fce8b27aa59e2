// Names of image sequences as other programs have them: "wave.####.exr", "wave.%04d.exr".
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pelagic::tools {

/// A plain file name around a frame's number: "wave." 0007 ".exr".
class NamePattern {
   public:
    /// None unless the text has exactly one number field, `#`s or `%0Nd` or `%d`, right before an extension of letters and
    /// digits, and is a name that a file may have: of printable ASCII, not hidden, no folder, at most 100 letters.
    static std::optional<NamePattern> parse(std::string_view text);

    /// Whether a text has such a field at all, so that it is meant as a pattern and not as a folder.
    static bool is_meant(std::string_view text);

    /// "wave.0007.exr", or with the mark "foam_c1" "wave.foam_c1.0007.exr": what tells apart the images of a frame.
    std::string name(std::string_view mark, int frame, std::string_view extension) const;

    /// For the mark and the frame number of a name that it can have given, with any extension; else nothing.
    struct Parts {
        std::string_view mark, extension;
    };
    std::optional<Parts> parts_of(std::string_view name) const;

    const std::string& extension() const { return extension_; }
    /// As it is recorded: "wave.####.exr".
    std::string text() const;

   private:
    std::string before_;      ///< "wave."
    std::size_t digits_ = 4;  ///< at least
    std::string extension_;   ///< "exr"
};

}  // namespace pelagic::tools
