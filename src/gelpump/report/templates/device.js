// A design in SI units, at once: numbers and lights of `gelpump.design`, by its own rules.
// Throws a Refusal, with what is allowed, for what is no design.
function evaluate(given) {
  const { a_0, a_1, heated_length: L, permeability: k, viscosity: mu, thermal_diffusivity: kappa } = given;
  for (const [key, value] of Object.entries(given)) {
    if (typeof value === "number" && !(value > 0 && Number.isFinite(value))) throw new Refusal(`${key.replaceAll("_", " ")} must be a number greater than 0`);
  }
  if (!(a_0 < a_1)) throw new Refusal("the inner radius must be less than the outer one");
  const { critical_temperature: T_C, heating_step: step } = given;
  if (!(step < T_C)) throw new Refusal("the heating step must leave the cold end above 0 K");
  const [T_cold, T_hot] = [T_C - step, T_C + step].map((T) => Number(T.toFixed(9)));
  const gel = material(given, T_cold, T_hot);
  const tube = { ell: a_0 / a_1, eps: a_1 / L, M: gel.M, Pi_ratio: gel.Pi_ratio, Phi_inf: gel.Phi_inf };
  const D = (k * gel.Pi_00) / mu;
  const [t_pore, Le] = [L ** 2 / D, kappa / D];
  const [tau_99, back] = [deswellingTime(tube), deswellingTime(tube, true)];
  const C = data.design.front_constant;
  const travel = L ** 2 / (C ** 2 * kappa);
  const quadrature = data.design.quadrature;
  const exact = (value) => [value, 0];
  const numbers = {
    ell: exact(tube.ell), eps: exact(tube.eps), wall: exact(a_1 - a_0),
    osmotic_modulus: exact(gel.Pi_00), shear_modulus: exact(gel.M * gel.Pi_00), M: exact(gel.M), Pi_ratio: exact(gel.Pi_ratio), Phi_inf: exact(gel.Phi_inf),
    diffusivity: exact(D), Lewis_number: exact(Le), coupling: exact(k / a_1 ** 2), poroelastic_time: exact(t_pore),
    tau_99: [tau_99, quadrature * tau_99], response_time: [t_pore * tau_99, quadrature * t_pore * tau_99], recovery_time: [t_pore * back, quadrature * t_pore * back],
    travel_time: exact(travel), front_coefficient: exact(C * Math.sqrt(kappa)), front_speed: exact(L / travel / 2),
  };
  const end = 1 / (C ** 2 * Le);
  const model = { tube, Le, tau_99, t_pore, end, late: false };
  if (end >= conserving(tube, tau_99)[1]) {
    model.pump = latePump(tube, Le, end, tau_99);
    model.late = Number.isFinite(model.pump.uncertainty.pumped_station);
  }
  const heat = heatOf(given, gel, tube, Le);
  Object.assign(numbers, heat.numbers);
  const lights = firstLights(given, gel, numbers, heat);
  if (model.late) {
    Object.assign(numbers, lateNumbers(given, model));
    Object.assign(lights, flowLights(given, gel, model, numbers));
  }
  return { numbers, lights: sortedLights(lights), model };
}

function lateNumbers({ a_0, a_1, heated_length: L }, { tube, Le, tau_99, t_pore, end, pump }) {
  const printedPulse = latePulse(tube, Le, end, tau_99);
  const [volume, speed, lumen] = [Math.PI * a_1 ** 2 * L, L / t_pore, Math.PI * a_0 ** 2];
  const number = ({ values, uncertainty }, name, scale) => [scale * values[name], uncertainty[name] * Math.abs(scale * values[name])];
  const flow = (late, name, front) => {
    const value = lumen * speed * late.values[name] * late.values[front] ** (-2 / 3);
    return [value, (late.uncertainty[name] + (2 / 3) * late.uncertainty[front]) * Math.abs(value)];
  };
  const [inPrint, doubt] = printedVolume(tube, Le, end, tau_99);
  const width = (2 * Math.atanh(0.8) * L) / printedPulse.values.A;
  return {
    final_front_polymer_ratio: number(printedPulse, "Phi1_front", 1), final_front_width: [width, width * printedPulse.uncertainty.A],
    final_departed_length: number(printedPulse, "departed_length", L),
    final_pumped_volume_conserving: number(pump, "pumped_station", volume), final_pumped_end_volume: number(pump, "pumped_end", volume),
    final_collapse_volume: number(pump, "collapse_station", volume), final_from_wall_volume: number(pump, "inner", volume),
    final_pumped_volume_printed: [volume * inPrint, doubt * Math.abs(volume * inPrint)],
    final_flow_front_conserving: flow(pump, "V_front", "pump_Phi1_front"), final_flow_far_conserving: number(pump, "pump_V_far", lumen * speed),
    final_flow_front_printed: flow(printedPulse, "V_peak", "Phi1_front"), final_flow_far_printed: number(printedPulse, "V_far", lumen * speed),
  };
}

// The lights that need no pulse: values by criterion.
function firstLights(given, gel, numbers, heat) {
  const { a_0, a_1, heated_length: L, permeability: k } = given;
  const lights = {
    slenderness: (a_1 / L) ** 2, coupling: k / a_1 ** 2, continuum: (a_1 - a_0) / Math.sqrt(k), plausible: plausible(given, numbers), heat: heat.light(),
  };
  let least = Infinity;
  const swollen = Math.abs(gel.diffusivity(1));
  for (let i = 0; i <= 2000; i++) least = Math.min(least, gel.diffusivity(1 + ((gel.Phi_inf - 1) * i) / 2000) / swollen);
  lights.one_phase = least;
  if (gel.energyBased) lights.linearisation = least > 0 ? Math.min(Math.abs(numbers.response_time[0] / ownTime(given, gel) - 1), 1e9) : 1e9;
  return lights;
}

// How far outside the usual ranges the worst input or result lies, as a factor.
function plausible(given, numbers) {
  let factor = 1;
  for (const [key, [low, high]] of Object.entries(data.design.usual)) {
    const value = numbers[key]?.[0] ?? given[key];
    if (value === undefined) continue;
    if (value < low || value > high) factor = Math.max(factor, low / value, value / high);
  }
  return factor;
}

// t_99 with the gel's own D in place of the tangents'.
function ownTime({ a_0, a_1, permeability: k, viscosity: mu }, gel) {
  const end = gel.Phi_inf;
  const perY = (y) => {
    const Phi = end / (1 + Math.exp(-y));
    return (Math.cbrt(Phi) * mu) / (end * k * gel.diffusivity(Phi));
  };
  const y = (Phi) => Math.log(Phi / (end - Phi));
  return ((a_1 - a_0) ** 2 / 16) * adaptive(perY, y(1), y(end - (end - 1) / 100));
}

// An integral by Gauss and Legendre, halved until two rules agree.
function adaptive(f, from, to, depth = 0) {
  const [middle, half] = [(from + to) / 2, (to - from) / 2];
  const [fine, coarse] = [24, 16].map((n) => half * gauss(n).reduce((sum, [node, weight]) => sum + weight * f(middle + half * node), 0));
  if (depth > 24 || Math.abs(fine - coarse) <= 1e-10 * Math.abs(fine)) return fine;
  return adaptive(f, from, middle, depth + 1) + adaptive(f, middle, to, depth + 1);
}

// Closeness, and the lumen's pressure and flow, as `gelpump.design.late` judges them.
function flowLights(given, gel, { tube, Le, tau_99, t_pore, end }, numbers) {
  const { a_0, heated_length: L, viscosity: mu, density } = given;
  const early = Math.max(end / data.design.times ** 2, conserving(tube, tau_99)[1]);
  const [inPrint, pump] = [latePulse(tube, Le, early, tau_99).values, latePump(tube, Le, early, tau_99).values];
  const peak = (L / t_pore) * Math.max(inPrint.V_peak, Math.abs(pump.V_front), Math.abs(pump.pump_V_far));
  return {
    closeness: numbers.final_departed_length[0] / L, lumen_pressure: (8 * mu * peak * L) / a_0 ** 2 / gel.Pi_00,
    reynolds: (((density * peak * a_0) / mu) * a_0) / L,
  };
}

// { key, value, light } in the order of the sheet; a value with whether it is open is amber then.
function sortedLights(values) {
  return Object.entries(data.design.criteria).filter(([key]) => key in values).map(([key, { green, amber, large }]) => {
    const [value, open] = [values[key]].flat();
    const within = (limit) => (large ? value >= limit * (1 - 1e-9) : value <= limit * (1 + 1e-9));
    return { key, value, open: Boolean(open), light: open ? "amber" : within(green) ? "green" : within(amber) ? "amber" : "red" };
  });
}
