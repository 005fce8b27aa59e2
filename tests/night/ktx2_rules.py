# Checks KTX2 files by the rules of the KTX File Format Specification 2.0 (revision 4) and of the
# Khronos Data Format Specification 1.4, for two-dimensional textures without block compression. It
# shares no code with the writer.
#
# usage: ktx2_rules.py FILE...
import math
import struct
import sys

# VkFormat: channels, bits of each, "UNORM" or "SFLOAT" (Vulkan specification, VkFormat).
FORMATS = {9: (1, 8, "UNORM"), 16: (2, 8, "UNORM"), 37: (4, 8, "UNORM"), 70: (1, 16, "UNORM"), 77: (2, 16, "UNORM"),
           91: (4, 16, "UNORM"), 76: (1, 16, "SFLOAT"), 83: (2, 16, "SFLOAT"), 97: (4, 16, "SFLOAT"), 100: (1, 32, "SFLOAT"),
           103: (2, 32, "SFLOAT"), 109: (4, 32, "SFLOAT")}


def check(data):
    def rule(holds, text):
        if not holds:
            raise SystemExit(f"{name}: {text}")

    rule(data[:12] == b"\xabKTX 20\xbb\r\n\x1a\n", "identifier")
    (vk_format, type_size, width, height, depth, layers, faces, levels, scheme) = struct.unpack_from("<9I", data, 12)
    dfd_at, dfd_size, kvd_at, kvd_size, sgd_at, sgd_size = struct.unpack_from("<4I2Q", data, 48)
    rule(vk_format in FORMATS, f"vkFormat {vk_format}")
    channels, bits, kind = FORMATS[vk_format]
    rule(type_size == bits // 8, "typeSize is not that of a component")
    rule(width > 0 and height > 0 and depth == 0 and layers == 0 and faces == 1, "not a two-dimensional texture")
    rule(1 <= levels <= 1 + int(math.log2(max(width, height))), "levelCount")
    rule(scheme in (0, 2), "supercompressionScheme")
    rule(sgd_size == 0 and sgd_at == 0, "supercompression global data without need")

    # The sections follow each other: index, descriptor, key/value data, levels.
    rule(dfd_at == 80 + 24 * levels, "dfdByteOffset")
    (total,) = struct.unpack_from("<I", data, dfd_at)
    rule(total == dfd_size and kvd_at - dfd_at == total, "dfdTotalSize")

    vendor, version_and_size, colour, dimensions, planes, more_planes = struct.unpack_from("<6I", data, dfd_at + 4)
    texel = channels * bits // 8
    rule(vendor == 0 and version_and_size & 0xFFFF == 2, "descriptor's vendor, type and version")
    rule(version_and_size >> 16 == 24 + 16 * channels == total - 4, "descriptorBlockSize")
    rule(colour & 0xFF == 1, "colorModel is not RGBSDA")
    rule(colour >> 16 & 0xFF == 1, "transferFunction is not linear")
    rule(colour >> 24 == 0, "flags: alpha is not premultiplied")
    rule(dimensions == 0 and planes == texel and more_planes == 0, "texelBlockDimension, bytesPlane")
    for channel in range(channels):
        word, position, lower, upper = struct.unpack_from("<4I", data, dfd_at + 28 + 16 * channel)
        rule(word & 0xFFFF == channel * bits and (word >> 16 & 0xFF) == bits - 1, "bitOffset, bitLength")
        rule(word >> 24 & 0xF == (0, 1, 2, 15)[channel], "channelType")
        rule(word >> 28 == (0xC if kind == "SFLOAT" else 0), "qualifiers")
        rule(position == 0, "samplePosition")
        limits = (0xBF800000, 0x3F800000) if kind == "SFLOAT" else (0, 2**bits - 1)
        rule((lower, upper) == limits, "sampleLower, sampleUpper")

    at, keys = kvd_at, []
    while at < kvd_at + kvd_size:
        (size,) = struct.unpack_from("<I", data, at)
        rule(size >= 2 and at + 4 + size <= kvd_at + kvd_size, "keyAndValueByteLength")
        key, value = data[at + 4:at + 4 + size].split(b"\0", 1)
        keys.append(key.decode())
        if key == b"KTXorientation":
            rule(value in (b"rd\0", b"ru\0"), "KTXorientation")
        padded = (4 + size + 3) // 4 * 4
        rule(not any(data[at + 4 + size:at + padded]), "valuePadding")
        at += padded
    rule(at == kvd_at + kvd_size, "kvdByteLength")
    rule(keys == sorted(set(keys)) and "KTXwriter" in keys, "keys are not sorted, or come twice")

    alignment = math.lcm(texel, 4) if scheme == 0 else 1
    end = kvd_at + kvd_size
    for level in reversed(range(levels)):
        offset, size, inflated = struct.unpack_from("<3Q", data, 80 + 24 * level)
        rule(offset == (end + alignment - 1) // alignment * alignment, f"byteOffset of level {level}")
        rule(not any(data[end:offset]), "mipPadding")
        rule(inflated == max(1, width >> level) * max(1, height >> level) * texel, f"uncompressedByteLength of level {level}")
        rule(scheme != 0 or size == inflated, f"byteLength of level {level}")
        end = offset + size
    rule(end == len(data), "the file goes on behind its largest level")


for name in sys.argv[1:]:
    with open(name, "rb") as file:
        check(file.read())
print(f"{len(sys.argv) - 1} files keep the rules of KTX 2.0")
