# Pillow places pictures on a page, and this compares the beads of a plate with them.
#   place_pictures.py draw FOLDER    draws map.png, a picture of directions, and mask.png.
#   place_pictures.py compare JSON   reads a view file, and prints as JSON how far its beads run from where the layer of a
#                                    plate would lay them: as it is told, and with one part of it misunderstood.
import json
import sys

from PIL import Image, ImageDraw, ImageFilter

SCALE = 4  # [pixels per mm]
MARGIN = 1.5  # [mm]; beads bend near borders
STEP = 4  # [texels]; comparing all of them would take long


def draw(folder):
    # Grey changes in one sense everywhere, so that no turned or mirrored part looks like another, and slowly, as beads bend.
    picture = Image.new("L", (90, 70))
    picture.putdata([round(40 + 0.6 * x + 1.4 * y + 0.004 * x * y) for y in range(70) for x in range(90)])
    picture.save(f"{folder}/map.png")
    # The flag has no symmetry, and lies away from the edges, since a drawing is placed by its ink alone.
    mask = Image.new("L", (120, 100))
    pen = ImageDraw.Draw(mask)
    pen.rectangle((10, 10, 44, 92), fill=255)
    pen.polygon(((45, 10), (114, 10), (90, 45), (45, 56)), fill=255)
    mask.save(f"{folder}/mask.png")


def degrees(grey, encoding):
    return grey / 255 * 180 - (90 if encoding == "angle" else 0)


def on_page(picture, layer, size, page):
    """Stretches a picture to a size in mm, mirrors it, turns it about its middle and puts it on an empty page."""
    placed = picture.resize([max(1, round(side * SCALE)) for side in size], Image.Resampling.NEAREST)
    if layer["mirror"]:
        placed = placed.transpose(Image.Transpose.FLIP_LEFT_RIGHT)
    placed = placed.rotate(layer["rotation"], Image.Resampling.NEAREST, expand=True)
    canvas = Image.new("L", [round(side * SCALE) for side in page])
    x, y = layer["at"][0] * SCALE, (page[1] - layer["at"][1]) * SCALE  # rows count from the top
    canvas.paste(placed, (round(x - placed.width / 2), round(y - placed.height / 2)))
    return canvas


def apart_from_edges(mask):
    """Returns the mask with less white, and with less black: what is near an edge is in neither."""
    near = 2 * round(MARGIN * SCALE) + 1
    return mask.filter(ImageFilter.MinFilter(near)), mask.filter(ImageFilter.MaxFilter(near))


def expected(layer, page, below):
    """Returns a function that tells the direction at a pixel and whether the layer lays it, or None near its edges."""
    picture = Image.open(layer["file"]).convert("L")
    if layer["kind"] == "drawing":
        picture = picture.point(lambda grey: 255 if grey >= 128 else 0)
        picture = picture.crop(picture.getbbox())
    else:
        (left, bottom), (right, top) = layer["cropMin"], layer["cropMax"]
        picture = picture.crop((round(left * picture.width), round((1 - top) * picture.height),
                                round(right * picture.width), round((1 - bottom) * picture.height)))
    width, height = layer["size"]
    width = width or height * picture.width / picture.height
    height = height or width * picture.height / picture.width
    cover = Image.new("L", picture.size, 255)
    if layer["kind"] == "drawing":
        cover = picture
    elif layer["mask"] == "inside":
        cover = Image.open(layer["maskFile"]).convert("L")
    inside, outside = apart_from_edges(on_page(cover, layer, (width, height), page))
    placed = on_page(picture, layer, (width, height), page)

    def at(pixel):
        if inside.getpixel(pixel) == 255:
            if layer["kind"] == "drawing":
                return layer["angle"], True
            own = degrees(placed.getpixel(pixel), layer["encoding"])
            return layer["rotation"] + (-own if layer["mirror"] else own), True
        return (below, False) if outside.getpixel(pixel) == 0 else None

    return at


def misunderstood(layer, page):
    """Yields the layer as it is told, and with one part of it taken the other way round."""
    yield "told", layer
    yield "rotation", {**layer, "rotation": -layer["rotation"]}
    yield "mirror", {**layer, "mirror": not layer["mirror"]}
    yield "at", {**layer, "at": [layer["at"][0], page[1] - layer["at"][1]]}
    if layer["kind"] == "map":
        (left, bottom), (right, top) = layer["cropMin"], layer["cropMax"]
        yield "crop", {**layer, "cropMin": [left, 1 - top], "cropMax": [right, 1 - bottom]}


def figures(errors):
    errors.sort()
    return {
        "compared": len(errors),
        "median": errors[len(errors) // 2],
        "off": sum(error > 8 for error in errors) / len(errors),
    }


def compare(told):
    page, layer = told["page"], told["layer"]
    view = Image.open(told["view"])
    plate = Image.new("L", [round(side * SCALE) for side in page])
    pen = ImageDraw.Draw(plate)
    (pen.ellipse if told["disc"] else pen.rectangle)((0, 0, plate.width - 1, plate.height - 1), fill=255)
    # Beyond the page there is no plate either, which Pillow's filters do not know.
    rim = round(MARGIN * SCALE)
    plate = apart_from_edges(plate)[0].crop((rim, rim, plate.width - rim, plate.height - rim))

    answer = {}
    for name, meant in misunderstood(layer, page):
        at = expected(meant, page, told["below"])
        errors = {True: [], False: []}
        for row in range(STEP // 2, view.height, STEP):
            for column in range(STEP // 2, view.width, STEP):
                angle, covered, _ = view.getpixel((column, row))
                pixel = (int((column + 0.5) / view.width * page[0] * SCALE), int((row + 0.5) / view.height * page[1] * SCALE))
                own = (pixel[0] - rim, pixel[1] - rim)
                if covered < 255 or not (0 <= own[0] < plate.width and 0 <= own[1] < plate.height):
                    continue
                if plate.getpixel(own) == 0:
                    continue
                wanted = at(pixel)
                if wanted is None:
                    continue
                # Lines have no sense: the distance of doubled angles, halved.
                errors[wanted[1]].append(abs((angle * 180 / 256 - wanted[0] + 90) % 180 - 90))
        answer[name] = {"layer": figures(errors[True]), "around": figures(errors[False])}
    print(json.dumps(answer))


if sys.argv[1] == "draw":
    draw(sys.argv[2])
else:
    compare(json.loads(sys.argv[2]))
