// A slender tube and its late pulse: `gelpump.tube.deswelling`, `wave.late_pulse`, `late_pump`.
// A tube is { ell, eps, M, Pi_ratio, Phi_inf }; lengths in L, times in poroelastic times.
const wallLength = ({ ell, eps }) => (eps * (1 - ell)) / 4;

// Nodes and weights of Gauss and Legendre, by Newton's method.
const rules = new Map();
function gauss(n) {
  if (!rules.has(n)) {
    const rule = [];
    for (let i = 0; i < n; i++) {
      let x = -Math.cos((Math.PI * (i + 0.75)) / (n + 0.5));
      let slope;
      for (let trial = 0; trial < 8; trial++) {
        let [before, now] = [1, x];
        for (let k = 2; k <= n; k++) [before, now] = [now, ((2 * k - 1) * x * now - (k - 1) * before) / k];
        slope = (n * (x * now - before)) / (x * x - 1);
        x -= now / slope;
      }
      rule.push([x, 2 / ((1 - x * x) * slope * slope)]);
    }
    rules.set(n, rule);
  }
  return rules.get(n);
}

// tau_99 of a tube heated everywhere, or of one cooled again.
function deswellingTime(tube, reswelling = false) {
  const { M, Pi_ratio, Phi_inf } = tube;
  const [start, end, s] = reswelling ? [Phi_inf, 1, 1] : [1, Phi_inf, Pi_ratio / Phi_inf];
  const y = (Phi) => (reswelling ? Math.log(Phi - end) : Math.log(Phi / (end - Phi)));
  const perY = (at) => {
    const Phi = reswelling ? end + Math.exp(at) : end / (1 + Math.exp(-at));
    return 1 / ((s * Math.cbrt(Phi) ** 2 + (4 * M) / 3) * (reswelling ? -Phi : end));
  };
  const [from, to] = [y(start), y(end - (end - start) / 100)];
  const half = (to - from) / 2;
  return wallLength(tube) ** 2 * half * gauss(64).reduce((sum, [node, weight]) => sum + weight * perY(from + half * (1 + node)), 0);
}

const lumenShare = (ell) => (1 / Math.log(1 / ell) - (2 * ell ** 2) / (1 - ell ** 2)) / 2;

// kappa, the consistent counterpart of the printed 16.
function sourceCoefficient(ell) {
  const m = (1 + ell) / 2;
  return (4 * (1 - ell) ** 2) / (1 - m ** 2 - ((1 - ell ** 2) * Math.log(1 / m)) / Math.log(1 / ell));
}

const frontAt = (Le, tau) => data.design.front_constant * Math.sqrt(Le * tau);
const frontSpeed = (Le, tau) => (data.design.front_constant / 2) * Math.sqrt(Le / tau);

// When the front had the speed that its wave has now, and whether there is a wave yet.
function delayed(tau, tau_99) {
  const then = tau - data.design.delay * tau_99;
  return then > 0 ? [then, true] : [tau, false];
}

// Relative uncertainties, by what was measured on solved pulses.
function stated(names, isWave, late, confined) {
  const found = {};
  for (const name of names) {
    const [floor, a, b] = data.design.stated[name];
    found[name] = isWave ? floor + a * late + b * confined : Infinity;
  }
  return found;
}

// The pulse as printed, at tau.
function latePulse(tube, Le, tau, tau_99) {
  const [w, p] = [wallLength(tube), Math.cbrt(tube.Phi_inf)];
  const [then, isWave] = delayed(tau, tau_99);
  const wave = travellingWave(tube.M, tube.Pi_ratio, tube.Phi_inf, p * w * frontSpeed(Le, then));
  const values = {
    A: wave.A / w, Phi1_front: wave.Phi1_front, departed_length: wave.departed_length * w, V_peak: wave.V_peak / w, V_far: wave.V_far / w,
  };
  const confined = Math.exp((-p * frontAt(Le, tau)) / w);
  return { values, uncertainty: stated(Object.keys(values), isWave && wave.mismatch < data.design.mismatch, (tau_99 / tau) ** 2, confined) };
}

// What of a wall that conserves water follows from lambda at one moment.
function pumpState(tube, Le, tau, w, tau_99) {
  const { ell, M, Pi_ratio, Phi_inf } = tube;
  const [h, sigma, section] = [Math.cbrt(1 / Phi_inf), lumenShare(ell), 1 - ell ** 2];
  const c = (w * frontSpeed(Le, delayed(tau, tau_99)[0])) / h;
  const sides = branches(M, Pi_ratio, Phi_inf, c, true);
  const stretch = meeting(...sides);
  const [flux, other] = sides.map((side) => side.end(stretch, WAVE_INTERVALS)[0]);
  const [behind, ahead] = sides.map((side) => {
    const [fine, coarse] = [WAVE_INTERVALS, WAVE_INTERVALS / 2].map((n) => side.amounts(stretch, n));
    return fine.map((value, i) => value + (value - coarse[i]) / 3);
  });
  const X_C = (frontAt(Le, tau) - w * behind[0]) / h;
  const loss = (1 - h ** 3) * X_C - w * (behind[1] - ahead[1]);
  const shorter = (1 - h) * X_C - w * (behind[0] - ahead[0]);
  const [collapse, inner] = [ell ** 2 * (loss - shorter), sigma * section * loss];
  const through = (1 + (sigma * section) / ell ** 2) * (3 * flux + c * (stretch ** 3 - h ** 3)) - 3 * flux;
  return {
    pumped_station: collapse + inner, pumped_end: ell ** 2 * loss + inner, collapse_station: collapse, inner, mismatch: Math.abs(flux - other) / Math.abs(flux),
    pump_Phi1_front: stretch ** -3, V_front: (c * (h - stretch) + through / stretch ** 2) / w,
  };
}

// w and tau_99 of the wall that conserves water.
function conserving(tube, tau_99) {
  const slower = 16 / sourceCoefficient(tube.ell);
  return [wallLength(tube) * Math.sqrt(slower), tau_99 * slower];
}

// Volumes in pi a_1^2 L, velocities in L per poroelastic time.
function latePump(tube, Le, tau, tau_99) {
  const [w, own] = conserving(tube, tau_99);
  const { mismatch, ...values } = pumpState(tube, Le, tau, w, own);
  const isWave = delayed(tau, own)[1] && mismatch < data.design.mismatch;
  const d = data.design.step;
  const [before, after] = [-1, 1].map((way) => pumpState(tube, Le, (1 + way * d) * tau, w, own).pumped_station);
  values.pump_V_far = (after - before) / (2 * d * tau) / tube.ell ** 2;
  const confined = Math.exp((-Math.cbrt(tube.Phi_inf) * frontAt(Le, tau)) / w);
  return { values, uncertainty: stated(Object.keys(values), isWave, (own / tau) ** 2, confined) };
}

// ell^2 times the integral of the printed V far ahead over time, and its relative uncertainty.
function printedVolume(tube, Le, tau, tau_99) {
  const [then, isWave] = delayed(tau, tau_99);
  const [fine, coarse] = data.design.nodes.map((nodes) => {
    let [volume, doubt] = [0, 0];
    for (const [point, weight] of gauss(nodes)) {
      const root = (Math.sqrt(then) * (1 + point)) / 2;
      const late = latePulse(tube, Le, root ** 2 + data.design.delay * tau_99, tau_99);
      const part = Math.sqrt(then) * weight * root * late.values.V_far;
      volume += part;
      doubt += part * Math.min(late.uncertainty.V_far, 1);
    }
    return { volume: tube.ell ** 2 * volume, doubt: doubt / volume };
  });
  return [fine.volume, isWave ? fine.doubt + Math.abs(coarse.volume / fine.volume - 1) : Infinity];
}
