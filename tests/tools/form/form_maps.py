"""Height maps for the tests of `mdof form`, written and read without mdof."""
import math


def grid(width_mm, height_mm, pixel_mm):
    """Positions of pixels, symmetric about (0, 0)."""
    nx, ny = round(width_mm / pixel_mm) + 1, round(height_mm / pixel_mm) + 1
    return ([round((i - (nx - 1) / 2) * pixel_mm, 9) for i in range(nx)],
            [round((j - (ny - 1) / 2) * pixel_mm, 9) for j in range(ny)])


def write_map(path, xs, ys, z_um, head="x_mm,y_mm,z_um"):
    """Writes a height map. z_um(x, y) returns the height, or None for a hole."""
    with open(path, "w") as file:
        file.write(head + "\n")
        for y in ys:
            for x in xs:
                z = z_um(x, y)
                if z is not None:
                    file.write(f"{x!r},{y!r},{z!r}\n")
    return path


def read_map(path):
    """Returns {(x, y): z} of the measured pixels."""
    with open(path) as file:
        assert file.readline() == "x_mm,y_mm,z_um\n"
        rows = [line.rstrip("\n").split(",") for line in file]
    return {(float(x), float(y)): float(z) for x, y, z in rows if z}


def rms(values):
    mean = sum(values) / len(values)
    return math.sqrt(sum((v - mean) ** 2 for v in values) / len(values))
