// The inverse question: a plain scan over a_1 and ell with all other inputs fixed, by the engine.
const SCAN = { ell: 37, a_1: 41, around: 10 }; // a_1 from a tenth to ten times that of the design

// What is scanned, one design at a time; wanted: { time, volume, wall, light }.
function* scanned(given, wanted) {
  const { model } = evaluate(given);
  const { tube, tau_99, t_pore } = model;
  const gel = material(given, given.critical_temperature - given.heating_step, given.critical_temperature + given.heating_step);
  const first = tau_99 / wallLength(tube) ** 2; // of every tube of this gel
  for (let j = 0; j < SCAN.ell; j++) {
    const ell = 0.05 + (0.9 * j) / (SCAN.ell - 1);
    for (let i = 0; i < SCAN.a_1; i++) {
      const a_1 = (given.a_1 / SCAN.around) * SCAN.around ** ((2 * i) / (SCAN.a_1 - 1));
      const here = { ...tube, ell, eps: a_1 / given.heated_length };
      const design = { ...given, a_0: ell * a_1, a_1 };
      const own = first * wallLength(here) ** 2;
      const point = { i, j, ell, a_1, time: t_pore * own, wall: a_1 - design.a_0, volume: pumpedVolume(design, here, model, own) };
      const red = worst(design, gel, point, here, model);
      point.feasible = point.time <= wanted.time && point.volume >= wanted.volume && point.wall >= wanted.wall && (wanted.light === "green" ? red === 0 : red < 2);
      yield point;
    }
  }
}

// In m^3; none where the pulse is not late.
function pumpedVolume({ a_1, heated_length }, tube, { Le, end }, tau_99) {
  const [w, own] = conserving(tube, tau_99);
  if (end < own) return NaN;
  const { pumped_station, mismatch } = pumpState(tube, Le, end, w, own);
  return mismatch < data.design.mismatch ? Math.PI * a_1 ** 2 * heated_length * pumped_station : NaN;
}

// The worst of the lights that need no pulse: 0 green, 1 amber, 2 red.
function worst(design, gel, { time }, tube, { Le }) {
  const section = Math.PI * design.a_1 ** 2;
  if (design.surrounding === "pipe" && design.pipe_section < section) return 2;
  const numbers = { Lewis_number: [Le], response_time: [time], osmotic_modulus: [gel.Pi_00], shear_modulus: [gel.M * gel.Pi_00] };
  const lights = sortedLights(firstLights(design, gel, numbers, heatOf(design, gel, tube, Le)));
  return largest(lights.map((each) => ["green", "amber", "red"].indexOf(each.light)));
}

// Those that no other one beats in both time and volume, the fastest first.
function pareto(points) {
  const front = [];
  for (const point of [...points].sort((a, b) => a.time - b.time || b.volume - a.volume)) {
    if (!front.length || point.volume > front[front.length - 1].volume) front.push(point);
  }
  return front;
}
