// A model of an extruder, of no program's making: how evenly plastic comes out along the oriented layer of a file.

/**
 * The oriented layer: its moves as the file writes them.
 * @returns {{ moves: { x: number, y: number, length: number, e: number, speed: number }[], seconds: number,
 *   slowest: number, acceleration: number, advance: boolean }} mm, mm/s, mm/s²; seconds by the F values alone; whether
 *   the file sets pressure advance
 */
export function faceOf(text) {
  const moves = [];
  let [x, y, speed, acceleration, oriented, advance] = [0, 0, 0, 1000, false, false];
  let axis = null; // of absolute E
  for (const line of text.split('\n')) {
    if (line.startsWith(';TYPE:')) oriented = line === ';TYPE:Top solid infill';
    if (/^M204 /.test(line)) acceleration = Number(line.match(/ [PS]([\d.]+)/)?.[1] ?? acceleration);
    if (/^M82\b/.test(line)) axis = 0;
    if (/^M83\b/.test(line)) axis = null;
    if (/^G92 E0/.test(line) && axis !== null) axis = 0;
    if (/^(M572 .*S|M900 .*K|SET_PRESSURE_ADVANCE .*ADVANCE=)0*\.?0*[1-9]/.test(line)) advance = true;
    if (!line.startsWith('G1 ')) continue;
    const word = (letter) => line.match(new RegExp(` ${letter}(-?[\\d.]+)`))?.[1];
    const to = { x: Number(word('X') ?? x), y: Number(word('Y') ?? y) };
    speed = Number(word('F') ?? speed * 60) / 60;
    let e = Number(word('E') ?? 0);
    if (axis !== null && word('E') !== undefined) [e, axis] = [e - axis, e];
    const length = Math.hypot(to.x - x, to.y - y);
    if (oriented && e > 0 && length > 0) {
      moves.push({ x: (to.x - x) / length, y: (to.y - y) / length, length, e, speed, acceleration });
    }
    [x, y] = [to.x, to.y];
  }
  return {
    moves,
    advance,
    seconds: moves.reduce((sum, move) => sum + move.length / move.speed, 0),
    slowest: Math.min(...[...new Set(moves.map((move) => move.speed))]),
  };
}

/** Squares of the speeds at the joints of moves: look-ahead with the junction rule that Klipper documents, 5 mm/s at 90°. */
function jointSpeeds(moves) {
  const corner = 25 * (Math.SQRT2 - 1);
  const joints = new Array(moves.length + 1).fill(0);
  for (let i = 1; i < moves.length; ++i) {
    const [a, b] = [moves[i - 1], moves[i]];
    const cosine = a.x * b.x + a.y * b.y;
    const half = Math.sqrt(Math.max(0, (1 + cosine) / 2)); // cosine of half the turn
    const most = half > 1 - 1e-9 ? Infinity : (corner * half) / (1 - half);
    joints[i] = Math.min(most, a.speed ** 2, b.speed ** 2);
  }
  for (let i = moves.length - 1; i > 0; --i) {
    joints[i] = Math.min(joints[i], joints[i + 1] + 2 * moves[i].acceleration * moves[i].length);
  }
  for (let i = 1; i < moves.length; ++i) {
    joints[i] = Math.min(joints[i], joints[i - 1] + 2 * moves[i - 1].acceleration * moves[i - 1].length);
  }
  return joints;
}

/**
 * The filament behind the nozzle is a spring: what comes out, u, follows what is pushed in, v, by lag · u' = v − u.
 * @param lag  [s]; no correction by the firmware
 * @returns {{ thin: number, thick: number }} shares of the length where u < 0.8 v and u > 1.3 v
 */
export function unevenShare({ moves }, lag) {
  const joints = jointSpeeds(moves);
  const step = 2e-4; // [s]
  let [thin, thick, total] = [0, 0, 0];
  let out = moves[0].speed * (moves[0].e / moves[0].length); // primed: the first millimetres are not judged
  moves.forEach((move, i) => {
    const perMm = move.e / move.length;
    const [before, after] = [joints[i], joints[i + 1]];
    for (let s = 0; s < move.length; ) {
      const square = Math.min(move.speed ** 2, before + 2 * move.acceleration * s, after + 2 * move.acceleration * (move.length - s));
      const speed = Math.max(1, Math.sqrt(square));
      const time = Math.min(step, (move.length - s) / speed);
      const pushed = speed * perMm;
      out += (pushed - out) * (1 - Math.exp(-time / lag));
      const piece = Math.max(speed * time, 1e-9);
      if (out < 0.8 * pushed) thin += piece;
      if (out > 1.3 * pushed) thick += piece;
      total += piece;
      s += piece;
    }
  });
  return { thin: thin / total, thick: thick / total };
}
