// The travelling wave of a late pulse: `gelpump.tube.wave` and its branches, one wave at a time.
const [WAVE_INTERVALS, WAVE_SEARCH, WAVE_GRADING] = [24, [4, 4, 8, 24], 3];
const WAVE_DEPARTED = 0.1;
const WAVE_FIT = 1e-4; // relative change of A at which its fit ends
const WAVE_WINDOW = 8; // in w, to either side, of that fit
const GAUSS3 = [[-Math.sqrt(0.6), 5 / 9], [0, 8 / 9], [Math.sqrt(0.6), 5 / 9]];

const trapezoid = (values, step) => values.slice(1).reduce((sum, value, i) => sum + ((value + values[i]) / 2) * step[i], 0);
const running = (values, step) => {
  const total = [0];
  for (let i = 1; i < values.length; i++) total.push(total[i - 1] + ((values[i] + values[i - 1]) / 2) * step[i - 1]);
  return total;
};

// One side, from its state of rest to the front; the flux j is K lambda_xi, or lambda^2 of it.
class Branch {
  constructor(rest, s, m, c, conservative) {
    Object.assign(this, { rest, s, m, c, conservative });
  }

  rho(stretch) {
    return this.s / stretch + this.m * stretch;
  }

  // S/(lambda - rest), which does not vanish at rest.
  source(stretch) {
    const product = stretch * this.rest;
    return (this.rho(stretch) * (stretch ** 2 + product + this.rest ** 2)) / (3 * product ** 3);
  }

  // d(j^2/2)/dlambda at c = 0: K S, or lambda^4 K S.
  drive(stretch) {
    const resistance = this.s + this.m * stretch ** 2;
    const cubes = (stretch - this.rest) * (stretch ** 2 + stretch * this.rest + this.rest ** 2);
    return (resistance ** 2 * cubes) / (3 * this.rest ** 3 * stretch ** (this.conservative ? 5 : 9));
  }

  // Nodes and flux from rest to lambda = front; each step is the root of a quadratic.
  solve(front, intervals) {
    const [stretch, flux] = [[this.rest], [0]];
    for (let i = 1; i <= intervals; i++) {
      stretch.push(this.rest + (front - this.rest) * (i / intervals) ** WAVE_GRADING);
      const [a, b] = [stretch[i - 1], stretch[i]];
      const driven = GAUSS3.reduce((sum, [point, weight]) => sum + weight * this.drive(a + ((1 + point) / 2) * (b - a)), 0) * (b - a);
      const half = (this.c * (this.conservative ? (b ** 3 - a ** 3) / 3 : b - a)) / 2;
      const here = flux[i - 1];
      flux.push(Math.sqrt(half ** 2 + here ** 2 + driven - 2 * half * here) - half);
    }
    return { stretch, flux };
  }

  // Extrapolated flux at the front, and its slope there.
  end(front, intervals) {
    const [fine, coarse] = [intervals, intervals / 2].map((n) => this.solve(front, n).flux[n]);
    const flux = fine + (fine - coarse) / 3;
    return [flux, this.drive(front) / flux - (this.conservative ? this.c * front ** 2 : this.c)];
  }

  // j/|lambda - rest| at rest, of a branch behind the front (sign 1) or ahead of it (-1).
  slopeAtRest(sign) {
    const scale = this.conservative ? this.rest ** 2 : 1;
    const curvature = this.rho(this.rest) * this.source(this.rest) / (this.conservative ? 1 : this.rest ** 4);
    const b = sign * this.c * scale;
    return Math.sqrt(b ** 2 / 4 + curvature) - b / 2;
  }

  // dxi/dlambda times the distance from rest, at the nodes: K/slope, or lambda^2 K/slope.
  lengths({ stretch, flux }) {
    const sign = Math.sign(stretch[stretch.length - 1] - this.rest);
    const slope = flux.map((j, i) => (i ? j / Math.abs(stretch[i] - this.rest) : this.slopeAtRest(sign)));
    return { slope, K: stretch.map((x) => this.rho(x) / x ** (this.conservative ? 2 : 4)) };
  }

  // Steps of Z in w from rest, w V gained from rest on, and its integral over Z.
  carried(solved) {
    const { stretch, flux } = solved;
    const { slope, K } = this.lengths(solved);
    const step = stretch.slice(1).map((x, i) => Math.abs(x - stretch[i]));
    const gain = stretch.map((x, i) => (1.5 * this.source(x) * K[i]) / (slope[i] * x ** 4));
    const V = running(gain, step);
    const over = V.map((value, i) => (i ? value / Math.abs(stretch[i] - this.rest) : gain[0]));
    const volume = trapezoid(stretch.map((x, i) => (over[i] * x * K[i]) / slope[i]), step);
    const Z = step.map((d, i) => {
      const ratio = Math.log(flux[i + 1] / flux[i]) / (flux[i + 1] - flux[i]);
      return ((stretch[i] * K[i] + stretch[i + 1] * K[i + 1]) / 2) * d * ratio;
    });
    return { Z, V: V[V.length - 1], volume };
  }

  // Integrals of |lambda - rest| and |lambda^3 - rest^3| over xi.
  amounts(front, intervals) {
    const solved = this.solve(front, intervals);
    const { slope, K } = this.lengths(solved);
    const { stretch } = solved;
    const step = stretch.slice(1).map((x, i) => Math.abs(x - stretch[i]));
    const first = K.map((value, i) => value / slope[i]);
    const third = first.map((value, i) => value * (stretch[i] ** 2 + stretch[i] * this.rest + this.rest ** 2));
    return [trapezoid(first, step), trapezoid(third, step)];
  }
}

function branches(M, Pi_ratio, Phi_inf, c, conservative) {
  const m = (4 * M) / 3;
  return [new Branch(Math.cbrt(1 / Phi_inf), Pi_ratio / Phi_inf, m, c, conservative), new Branch(1, 1, m, c, conservative)];
}

// lambda at the front, where the fluxes of the branches meet, by Newton's method.
function meeting(hot, cold) {
  const [low, high] = [hot.rest, cold.rest];
  const chord = hot.solve(high, 4).flux[4] / (high - low);
  const tangent = cold.slopeAtRest(-1);
  let front = (tangent * high + chord * low) / (tangent + chord);
  for (const intervals of WAVE_SEARCH) {
    const [[j, slope], [k, other]] = [hot, cold].map((branch) => branch.end(front, intervals));
    const next = front - (j - k) / (slope - other);
    front = Math.min(Math.max(next, front + 0.8 * (low - front)), front + 0.8 * (high - front));
  }
  return front;
}

// A w, Phi_1 at the front, departed length, w V at the front and far ahead; its shape in `profile`.
function travellingWave(M, Pi_ratio, Phi_inf, c, conservative = false) {
  const [hot, cold] = branches(M, Pi_ratio, Phi_inf, c, conservative);
  const front = meeting(hot, cold);
  const coarse = waveOn(hot, cold, front, Phi_inf, WAVE_INTERVALS / 2);
  const fine = waveOn(hot, cold, front, Phi_inf, WAVE_INTERVALS, coarse.A);
  const found = { Phi1_front: front ** -3, profile: fine.profile };
  for (const name of ["A", "departed_length", "V_peak", "V_far"]) found[name] = fine[name] + (fine[name] - coarse[name]) / 3;
  found.mismatch = Math.abs(fine.mismatch + (fine.mismatch - coarse.mismatch) / 3);
  return found;
}

function waveOn(hot, cold, front, Phi_inf, intervals, A) {
  const [there, here] = [hot, cold].map((branch) => branch.solve(front, intervals));
  const [behind, ahead] = [hot.carried(there), cold.carried(here)];
  const near = WAVE_DEPARTED * (Phi_inf - 1);
  const fraction = (x) => x ** -3;
  const departed =
    waveDistance(behind.Z, there.stretch.map((x) => Phi_inf - fraction(x)), near) +
    waveDistance(ahead.Z, here.stretch.map((x) => fraction(x) - 1), near);
  // from far behind to far ahead, without the states of rest, which are infinitely far away
  const steps = [...behind.Z.slice(1), ...ahead.Z.slice(1).reverse()];
  const Z = [-behind.Z.slice(1).reduce((sum, step) => sum + step, 0)];
  for (const step of steps) Z.push(Z[Z.length - 1] + step);
  const Phi = [...there.stretch.slice(1), ...here.stretch.slice(1, -1).reverse()].map(fraction);
  const [j, k] = [there, here].map((side) => side.flux[intervals]);
  return { A: tanhFit(Z, Phi, Phi_inf, A ?? 2.25 / departed), departed_length: departed, V_peak: behind.V, V_far: behind.V - ahead.V, profile: { Z, Phi }, mismatch: (j - k) / (j + k) };
}

// From the front to where the departure from rest, rising along the nodes, is `near`.
function waveDistance(Z, departure, near) {
  if (departure[departure.length - 1] <= near) return 0;
  const beyond = Math.min(Math.max(departure.filter((value) => value < near).length - 1, 0), Z.length - 1);
  const covered = Z.slice(beyond).reduceRight((sum, step) => sum + step, 0);
  const [low, high] = [departure[beyond], departure[beyond + 1]];
  const share = Math.log(near / low) / Math.log(high / low);
  return covered - Math.min(Math.max(share, 0), 1) * Z[beyond];
}

// A w by Newton's iteration for ln A.
function tanhFit(Z, Phi, Phi_inf, start) {
  const clip = (z) => Math.min(Math.max(z, -WAVE_WINDOW), WAVE_WINDOW);
  const at = [Math.min(Z[0], -WAVE_WINDOW), ...Z, Math.max(Z[Z.length - 1], WAVE_WINDOW)].map(clip);
  const half = (Phi_inf - 1) / 2;
  const above = [Phi_inf, ...Phi, 1].map((value) => (value - (1 + Phi_inf) / 2) / half);
  const weight = at.map((z, i) => ((i ? z - at[i - 1] : 0) + (i < at.length - 1 ? at[i + 1] - z : 0)) / 2);
  let A = start;
  for (let trial = 0; trial < 40; trial++) {
    let [gradient, square, bent] = [0, 0, 0];
    at.forEach((z, i) => {
      const tanh = Math.tanh(A * z);
      const slope = A * z * (tanh * tanh - 1); // of the misfit, by ln A
      const pull = weight[i] * slope * (above[i] + tanh);
      gradient += pull;
      square += weight[i] * slope * slope;
      bent += 2 * pull * A * z * tanh;
    });
    const step = gradient / Math.max(square + bent - gradient, square / 2);
    A *= Math.exp(Math.min(Math.max(step, -1), 1));
    if (Math.abs(step) < WAVE_FIT) break;
  }
  return A;
}
