# Measures of an image's texture in named rectangles.
import numpy as np

# Scene: region: first row, last row, first column, last column; of 480 x 270 pixels.
regions = {
    "rough": {"glitter": (200, 266, 170, 330), "left near": (190, 266, 20, 150)},
    "calm": {"near": (200, 266, 0, 480), "middle": (160, 200, 0, 480), "both": (160, 266, 0, 480)},
}
boxes = (4, 8, 16, 32)
outlier_stops, jump_stops = 0.4, 0.5


def luminance(image):
    return image[..., :3] @ np.array((0.2126, 0.7152, 0.0722))


def contrast(stops, box):
    """Returns the mean of the standard deviations in boxes."""
    rows, columns = (size // box for size in stops.shape)
    cells = stops[:rows * box, :columns * box].reshape(rows, box, columns, box)
    return cells.std(axis=(1, 3)).mean()


def outliers(stops):
    """Returns the fractions of pixels brighter and darker than all eight neighbours by more than
    `outlier_stops`."""
    rows, columns = stops.shape
    middle = stops[1:-1, 1:-1]
    around = np.stack([stops[1 + j:rows - 1 + j, 1 + i:columns - 1 + i]
                       for j in (-1, 0, 1) for i in (-1, 0, 1) if i or j])
    return (middle - around.max(0) > outlier_stops).mean(), (around.min(0) - middle > outlier_stops).mean()


def measures(image, scene):
    """Returns the measures of each region. `quartiles` is the range between the quartiles, `jumps`
    the fraction of horizontal neighbours that differ by more than `jump_stops`. All are of the
    luminance's logarithm to base 2, except `mean`."""
    found = {}
    for name, (top, bottom, left, right) in regions[scene].items():
        light = luminance(np.asarray(image, np.float64))[top:bottom, left:right]
        stops = np.log2(np.maximum(light, 1e-6))
        bright, dark = outliers(stops)
        low, high = np.percentile(stops, (25, 75))
        values = {f"contrast {box}": contrast(stops, box) for box in boxes}
        values.update(bright=bright, dark=dark, jumps=(np.abs(np.diff(stops, axis=1)) > jump_stops).mean(),
                      quartiles=high - low, mean=light.mean())
        found[name] = {key: float(value) for key, value in values.items()}
    return found
