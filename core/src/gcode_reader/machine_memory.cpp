#include "gcode_reader/machine.hpp"

#include "gcode_reader/macros.hpp"

namespace sillon {
namespace {

constexpr std::size_t kMostSaved = 16;    // states, at most: more than the stack of any firmware holds
constexpr std::size_t kMostHolding = 64;  // tools with filament held back, at most

MachineMemory memoryOf(const MachineState& state) { return state.memory ? *state.memory : MachineMemory{}; }

// Puts the state aside under a name, which replaces one of the same name; without a name, on the stack.
void save(MachineState& state, std::string name) {
  MachineMemory memory = memoryOf(state);
  if (!name.empty()) std::erase_if(memory.states, [&](const auto& entry) { return entry.first == name; });
  if (memory.states.size() >= kMostSaved) return;
  memory.states.emplace_back(std::move(name), SavedState{state.absolute, state.absoluteE, state.inches, state.speed,
                                                         state.at, state.z, state.origin, state.originZ, state.e});
  state.memory = std::make_shared<const MachineMemory>(std::move(memory));
}

// The last state with this name; null: none.
const SavedState* savedAs(const MachineState& state, std::string_view name) {
  if (!state.memory) return nullptr;
  const auto& states = state.memory->states;
  const auto found =
      std::find_if(states.rbegin(), states.rend(), [&](const auto& entry) { return entry.first == name; });
  return found == states.rend() ? nullptr : &found->second;
}

// Takes modes and speed from a state that was put aside.
void restoreModes(MachineState& state, const SavedState& saved) {
  state.absolute = saved.absolute;
  state.absoluteE = saved.absoluteE;
  state.inches = saved.inches;
  state.speed = saved.speed;
}

// Runs RESTORE_GCODE_STATE, which restores modes, origin and the last E. \param goes  MOVE=1: the nozzle goes back,
// too. \param speed  of that move [mm/s]; 0: unchanged.
std::optional<MachineMove> restore(MachineState& state, const std::string& name, bool goes, double speed) {
  const SavedState* const found = savedAs(state, name);
  if (found == nullptr) return std::nullopt;
  const SavedState saved = *found;
  restoreModes(state, saved);
  state.origin = saved.origin;
  state.originZ = saved.originZ;
  state.e = saved.e;
  if (!goes) return std::nullopt;
  MachineMove move;
  move.from = state.at;
  move.zFrom = state.z;
  state.at = move.to = saved.at;
  state.z = move.z = saved.z;
  if (speed > 0) state.speed = speed;
  move.xy = true;
  move.length = length(move.to - move.from);
  return move;
}

}  // namespace

void changeTool(MachineState& state, int tool) {
  if (tool < 0 || tool == state.tool) return;
  MachineMemory memory = memoryOf(state);
  const auto isTool = [](int number) { return [number](const auto& entry) { return entry.first == number; }; };
  std::erase_if(memory.tools, isTool(state.tool));
  const HeldFilament held{state.retracted, state.firmwareRetracted};
  if ((held.retracted > 0 || held.firmwareRetracted) && memory.tools.size() < kMostHolding) {
    memory.tools.emplace_back(state.tool, held);
  }
  const auto own = std::find_if(memory.tools.begin(), memory.tools.end(), isTool(tool));
  const HeldFilament now = own == memory.tools.end() ? HeldFilament{} : own->second;
  state.retracted = now.retracted;
  state.firmwareRetracted = now.firmwareRetracted;
  state.tool = tool;
  state.memory = std::make_shared<const MachineMemory>(std::move(memory));
}

void pushModes(MachineState& state) { save(state, {}); }

void popModes(MachineState& state) {
  const SavedState* const saved = savedAs(state, "");
  if (saved == nullptr) return;
  restoreModes(state, *saved);
  MachineMemory memory = memoryOf(state);
  const auto last =
      std::find_if(memory.states.rbegin(), memory.states.rend(), [](const auto& entry) { return entry.first.empty(); });
  memory.states.erase(std::next(last).base());
  state.memory = std::make_shared<const MachineMemory>(std::move(memory));
}

std::optional<MachineMove> runMemory(MachineState& state, const GcodeCommand& command) {
  if (command.name.find('_') == std::string_view::npos) return std::nullopt;
  const std::string upper = upperCase(command.name);
  const bool saves = upper == "SAVE_GCODE_STATE";
  if (!saves && upper != "RESTORE_GCODE_STATE") return std::nullopt;
  std::string name = "default";
  double goes = 0;
  double speed = 0;
  forEachParameter(command.rest, [&](const std::string& key, std::string_view value) {
    if (key == "NAME" && !value.empty()) name = std::string(value.substr(0, 60));
    if (key == "MOVE") readNumber(value, goes);
    if (key == "MOVE_SPEED") readNumber(value, speed);
  });
  if (!saves) return restore(state, name, goes > 0, speed);
  save(state, std::move(name));
  return std::nullopt;
}

}  // namespace sillon
