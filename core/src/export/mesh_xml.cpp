#include "export/mesh.hpp"

#include "base/numbers.hpp"

namespace sillon {

std::string resourcesOf(const Mesh& mesh) {
  std::string xml = " <resources>\n  <object id=\"1\" type=\"model\">\n   <mesh>\n    <vertices>\n";
  for (const auto& p : mesh.points) {
    xml +=
        "     <vertex x=\"" + decimal(p[0], 3) + "\" y=\"" + decimal(p[1], 3) + "\" z=\"" + decimal(p[2], 6) + "\"/>\n";
  }
  xml += "    </vertices>\n    <triangles>\n";
  for (const auto& t : mesh.triangles) {
    xml += "     <triangle v1=\"" + std::to_string(t[0]) + "\" v2=\"" + std::to_string(t[1]) + "\" v3=\"" +
           std::to_string(t[2]) + "\"/>\n";
  }
  return xml + "    </triangles>\n   </mesh>\n  </object>\n </resources>\n";
}

}  // namespace sillon
