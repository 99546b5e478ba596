#include "base/json.hpp"

namespace sillon {
namespace {

constexpr auto kReplace = Json::error_handler_t::replace;

}  // namespace

Json parseJson(std::string_view text) { return Json::parse(text, nullptr, false); }

std::string jsonText(const Json& value) { return value.dump(-1, ' ', false, kReplace); }

std::string jsonString(std::string_view text) { return jsonText(Json(text)); }

std::string jsonNumber(double value) { return jsonText(Json(value)); }

}  // namespace sillon
