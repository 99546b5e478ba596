#include "input/svg/svg_style.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace sillon::svg {
namespace {

constexpr std::string_view kNames =
    "aliceblue antiquewhite aqua aquamarine azure beige bisque black blanchedalmond blue blueviolet "
    "brown burlywood cadetblue chartreuse chocolate coral cornflowerblue cornsilk crimson cyan darkblue "
    "darkcyan darkgoldenrod darkgray darkgreen darkgrey darkkhaki darkmagenta darkolivegreen darkorange "
    "darkorchid darkred darksalmon darkseagreen darkslateblue darkslategray darkslategrey darkturquoise "
    "darkviolet deeppink deepskyblue dimgray dimgrey dodgerblue firebrick floralwhite forestgreen "
    "fuchsia gainsboro ghostwhite gold goldenrod gray green greenyellow grey honeydew hotpink indianred "
    "indigo ivory khaki lavender lavenderblush lawngreen lemonchiffon lightblue lightcoral lightcyan "
    "lightgoldenrodyellow lightgray lightgreen lightgrey lightpink lightsalmon lightseagreen "
    "lightskyblue lightslategray lightslategrey lightsteelblue lightyellow lime limegreen linen magenta "
    "maroon mediumaquamarine mediumblue mediumorchid mediumpurple mediumseagreen mediumslateblue "
    "mediumspringgreen mediumturquoise mediumvioletred midnightblue mintcream mistyrose moccasin "
    "navajowhite navy oldlace olive olivedrab orange orangered orchid palegoldenrod palegreen "
    "paleturquoise palevioletred papayawhip peachpuff peru pink plum powderblue purple rebeccapurple red "
    "rosybrown royalblue saddlebrown salmon sandybrown seagreen seashell sienna silver skyblue slateblue "
    "slategray slategrey snow springgreen steelblue tan teal thistle tomato turquoise violet wheat white "
    "whitesmoke yellow yellowgreen accentcolor accentcolortext activetext buttonborder buttonface "
    "buttontext canvas canvastext field fieldtext graytext highlight highlighttext linktext mark "
    "marktext selecteditem selecteditemtext visitedtext window windowtext";

constexpr std::uint16_t digest(std::string_view name) {
  std::uint32_t hash = 2166136261;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619;
  return static_cast<std::uint16_t>(hash >> 16);
}

// The names themselves would make this room's WebAssembly larger by 1.5 KB; one other word in 400 passes for a name.
constexpr auto kDigests = [] {
  std::array<std::uint16_t, std::count(kNames.begin(), kNames.end(), ' ') + 1> digests{};
  std::string_view rest = kNames;
  for (std::uint16_t& d : digests) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    d = digest(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return digests;
}();

}  // namespace

bool isColorName(std::string_view name) {
  return std::find(kDigests.begin(), kDigests.end(), digest(name)) != kDigests.end();
}

}  // namespace sillon::svg
