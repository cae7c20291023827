// Heat that the collapse takes, and how far it holds the front back: `gelpump.design.heat`,
// `gelpump.tube.stefan`.
const erf = (y) => (y / Math.sqrt(Math.PI)) * gauss(48).reduce((sum, [x, w]) => sum + w * Math.exp(-(((y * (1 + x)) / 2) ** 2)), 0);

// e^(y^2) erfc(y)
function erfcx(y) {
  const far = Math.min(7, 20 / y);
  const at = (x) => (far * (1 + x)) / 2;
  return (far / Math.sqrt(Math.PI)) * gauss(64).reduce((sum, [x, w]) => sum + w * Math.exp(-(at(x) ** 2) - 2 * y * at(x)), 0);
}

// e^-y [I_0(y) + I_1(y)], by their integral or, far out, their series.
function besselSum(y) {
  if (y < 50) {
    const n = 80;
    let sum = 1;
    for (let i = 1; i < n; i++) {
      const cosine = Math.cos((Math.PI * i) / n);
      sum += Math.exp(y * (cosine - 1)) * (1 + cosine);
    }
    return sum / n;
  }
  const series = (square) => {
    let [term, sum] = [1, 1];
    for (let k = 1; k <= 8; k++) sum += term *= -(square - (2 * k - 1) ** 2) / (8 * k * y);
    return sum;
  };
  return (series(0) + series(4)) / Math.sqrt(2 * Math.PI * y);
}

// -d ln Z_C / d(f St p) in a bath; thin is eps^2.
function heldBack(thin) {
  const c = data.design.front_constant;
  const felt = gauss(200).reduce((sum, [x, weight]) => {
    const v = (1 + x) / 2;
    const z = Math.sqrt(1 - v * v);
    const spread = Math.exp(-(((c * (1 - z)) / (2 * v)) ** 2)) - Math.exp(-(((c * (1 + z)) / (2 * v)) ** 2));
    return sum + ((weight / 2) * spread * (1 - besselSum((c * c * thin) / (2 * v * v)))) / z;
  }, 0);
  return felt / 4 / Math.exp((-c * c) / 4);
}

// Phi_1 at a front at rest of the wall that conserves water.
function restingFraction({ M, Pi_ratio, Phi_inf }) {
  const [m, behind] = [(4 * M) / 3, Math.cbrt(1 / Phi_inf)];
  const Q = (x, s, Phi_0) =>
    (Phi_0 * (-(s ** 2) / x + 2 * s * m * x + (m ** 2 * x ** 3) / 3) + s ** 2 / (4 * x ** 4) + (s * m) / x ** 2 - m ** 2 * Math.log(x)) / 3;
  const s = Pi_ratio / Phi_inf;
  return roots((x) => Q(x, s, Phi_inf) - Q(behind, s, Phi_inf) - Q(x, 1, 1) + Q(1, 1, 1), [behind, 1])[0] ** -3;
}

// What of the heat of the water that circulates is left: E and W of an insulated tube.
function circulated(tube, Le) {
  const { ell, M, Pi_ratio, Phi_inf } = tube;
  const outwards = (1 - lumenShare(ell)) * (1 - ell ** 2);
  const front = Math.cbrt(1 / restingFraction(tube));
  const potential = (x, s) => -s / (3 * x ** 3) - (4 * M) / (3 * x);
  let [carried, W] = [0, 0];
  for (const [low, high, s] of [[front, 1, 1], [Math.cbrt(1 / Phi_inf), front, Pi_ratio / Phi_inf]]) {
    for (const [node, weight] of gauss(40)) {
      const x = (low + high + (high - low) * node) / 2;
      const Gamma = carried + 3 * outwards * (potential(high, s) - potential(x, s));
      W += ((high - low) / 2) * weight * 3 * x ** 2 * Math.exp(-Gamma / Le);
    }
    carried += 3 * outwards * (potential(high, s) - potential(low, s));
  }
  return [Math.exp(-carried / Le), W / (1 - 1 / Phi_inf)];
}

// Relative shift of the front in a surrounding, long after the start.
function frontShift(tube, Le, St, kind, section) {
  const [p, q, a] = [Math.cbrt(tube.Phi_inf), tube.Phi_inf ** (-2 / 3), 1 - tube.ell ** 2];
  if (kind === "bath") return -a * p * St * heldBack(tube.eps ** 2);
  const [E, W] = kind === "insulated" ? circulated(tube, Le) : [1, 1];
  const S = kind === "insulated" ? q * E : 1;
  const beta = kind === "insulated" ? a * (p - 1) - tube.ell ** 2 * (1 - q) - lumenShare(tube.ell) * a * (p - q) : 0;
  const consumed = (a / section) * St * p * W;
  const excess = (y) => (S * Math.exp(-(y ** 2))) / erf(y) - 1 / erfcx((1 + beta) * y) - Math.sqrt(Math.PI) * y * consumed;
  return (2 * (roots(excess, [1e-8, 5])[0] ?? 0)) / data.design.front_constant - 1;
}

// Numbers, and the light with whether it is open; energies tell a heat of their own.
function heatOf(given, gel, tube, Le) {
  const { enthalpy, surrounding, heat_capacity, heating_step, polymer_density, repeat_unit, a_1, pipe_section } = given;
  const stored = heat_capacity * heating_step;
  const section = surrounding === "pipe" ? pipe_section / (Math.PI * a_1 ** 2) : 1;
  if (section < 1) throw new Refusal("the section of the pipe must be at least that of the tube");
  const latent = (heat) => (heat * polymer_density) / repeat_unit;
  const stefan = (heat) => (gel.phi_00 * latent(heat)) / stored;
  const numbers = { P: [gel.Pi_00 / stored, 0] };
  if (enthalpy) numbers.latent_heat = [latent(enthalpy), 0];
  if (gel.energyBased) numbers.own_latent_heat = [gel.ownHeat(given.critical_temperature), 0];
  const shift = (kind, St) => frontShift(tube, Le, St, kind, section);
  if (enthalpy && gel.phi_00) {
    const St = stefan(enthalpy);
    numbers.St = [St, 0];
    if (surrounding === "pipe" || surrounding === "insulated") numbers.f_St = [(St * (1 - tube.ell ** 2)) / section, 0];
    if (surrounding !== "unknown" && shift(surrounding, St) > -1) {
      const root = data.design.front_constant * (1 + shift(surrounding, St));
      numbers.travel_time_held_back = [given.heated_length ** 2 / given.thermal_diffusivity / root ** 2, 0];
    }
  }
  return { numbers, light: () => heatLight(given, gel, stefan, shift) };
}

function heatLight({ enthalpy, surrounding }, gel, stefan, shift) {
  if (!gel.phi_00) return [0, true];
  const value = Math.abs(shift(surrounding === "unknown" ? "bath" : surrounding, stefan(enthalpy ?? data.design.usual_enthalpy)));
  if (surrounding === "unknown") return [value, true];
  const green = data.design.criteria.heat.green;
  return [value, !enthalpy && surrounding !== "insulated" && value > green * (1 + 1e-9)];
}
