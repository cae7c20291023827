// A gel in pascal: moduli as given, or tangents of a free energy at its two equilibria
// (`gelpump.design.material`). Energies are told by c_k = p_k + q_k s of `materials.flory_rehner`.
const BOLTZMANN = 1.380649e-23;

class Refusal extends Error {}

const geometric = (from, to, n) => Array.from({ length: n }, (_, i) => from * (to / from) ** (i / (n - 1)));
const GEL_SEARCH = [
  ...geometric(1e-9, 0.05, 801),
  ...Array.from({ length: 1800 }, (_, i) => 0.05 + (0.9 * (i + 1)) / 1801),
  ...geometric(0.05, 1e-15, 801).map((x) => 1 - x),
];

// The root of a function in every interval between neighbouring ends with a change of sign.
function roots(f, ends) {
  const found = [];
  let before = f(ends[0]) > 0;
  for (let i = 1; i < ends.length; i++) {
    const now = f(ends[i]) > 0;
    if (now !== before) {
      let [low, high] = [ends[i - 1], ends[i]];
      for (let trial = 0; trial < 200; trial++) {
        const middle = high > 4 * low ? Math.sqrt(low * high) : (low + high) / 2;
        if (middle <= low || middle >= high) break;
        if (f(middle) > 0 === before) low = middle;
        else high = middle;
      }
      found.push((low + high) / 2);
    }
    before = now;
  }
  return found;
}

class ExplicitGel {
  constructor(given) {
    Object.assign(this, given);
  }

  coefficients(T) {
    const s = this.inverse ? 1 / T : T;
    return this.constant.map((p, k) => p + this.slope[k] * s);
  }

  ionicStrength(phi) {
    return Math.hypot(this.charge * phi, 2 * this.salt);
  }

  ionicModulus(phi) {
    return this.charge ? (this.charge * phi) ** 2 / this.ionicStrength(phi) : 0;
  }

  athermal(phi) {
    let tail = -Math.log1p(-phi) - phi;
    if (phi < 0.1) {
      tail = 0;
      for (let k = 19; k >= 2; k--) tail = tail * phi + 1 / k;
      tail *= phi ** 2;
    }
    const q = this.charge * phi;
    const ionic = this.charge ? q * (q / (this.ionicStrength(phi) + 2 * this.salt)) : 0;
    return (this.kappa * phi - Math.cbrt(phi)) / this.Omega + ionic + tail;
  }

  pressure(phi, T) {
    const [a, b, c] = this.coefficients(T);
    return this.athermal(phi) - phi ** 2 * (a + phi * (b + phi * c));
  }

  mixing(phi, T) {
    const [a, b, c] = this.coefficients(T);
    return 1 / (1 - phi) - 2 * a - 3 * b * phi - 4 * c * phi ** 2;
  }

  osmoticModulus(phi, T) {
    return (this.kappa * phi - Math.cbrt(phi) / 3) / this.Omega + this.ionicModulus(phi) + phi ** 2 * this.mixing(phi, T);
  }

  diffusivity(phi, T) {
    return (this.kappa * phi + Math.cbrt(phi)) / this.Omega + this.ionicModulus(phi) + phi ** 2 * this.mixing(phi, T);
  }

  // T^2 times the slope in T of the interaction's energy: all of it that depends on T.
  heat(phi, T) {
    const [a, b, c] = this.slope;
    return (this.inverse ? -1 : T ** 2) * phi * (a + phi * (b / 2 + (phi * c) / 3));
  }

  // The sign of dT_eq/dphi: N' Q - N Q' of s_eq = N/Q.
  turning(phi) {
    const athermal = this.athermal(phi);
    const slope = (this.kappa - Math.cbrt(phi) ** -2 / 3) / this.Omega + phi / (1 - phi) + this.ionicModulus(phi) / phi;
    const [[P, dP], [Q, dQ]] = [this.constant, this.slope].map(([a, b, c]) => [a + phi * (b + phi * c), b + 2 * c * phi]);
    return ((slope - (2 * athermal) / phi) / phi ** 2 - dP) * Q - (athermal / phi ** 2 - P) * dQ;
  }

  // Ends of the intervals in which each temperature is met at most once.
  pieces() {
    this.ends ??= [GEL_SEARCH[0], ...roots((phi) => this.turning(phi), GEL_SEARCH), ...this.poles, GEL_SEARCH[GEL_SEARCH.length - 1]].sort((a, b) => a - b);
    return this.ends;
  }

  // The least concentrated stable state.
  equilibrium(T) {
    const stable = roots((phi) => this.pressure(phi, T), this.pieces()).filter((phi) => this.osmoticModulus(phi, T) > 0);
    if (!stable.length) throw new Refusal(`${this.name} has no stable equilibrium at ${printed(T)} K`);
    return stable[0];
  }
}

// Pi_00 and D over Phi of a design's gel: { Pi_00, M, Pi_ratio, Phi_inf, phi_00, own }.
function material(given, T_cold, T_hot) {
  if (given.gel === "own") {
    const { osmotic_modulus: Pi_00, osmotic_modulus_hot: hot, shear_modulus: mu_s, polymer_fraction: phi_00, polymer_fraction_hot: phi_hot } = given;
    if (!(phi_00 < 1 && phi_hot < 1)) throw new Refusal("polymer fractions must be less than 1");
    if (!(phi_hot > phi_00)) throw new Refusal("the polymer fraction when hot must be greater than when cold: the gel collapses");
    return { ...linearGel(Pi_00, mu_s / Pi_00, hot / Pi_00, phi_hot / phi_00), phi_00 };
  }
  const gel = data.design.gels[given.gel];
  if (gel.kind === "ratios") return linearGel(given.osmotic_modulus, gel.M, gel.Pi_ratio, gel.Phi_inf);
  const own = (gel.explicit ??= new ExplicitGel(gel));
  const [lowest, highest] = gel.range;
  for (const T of [T_cold, T_hot]) {
    if (!(T >= lowest && T <= highest)) throw new Refusal(`${gel.name} is known from ${lowest} to ${highest} K: ${printed(T, 6)} K is outside`);
  }
  const [phi_00, phi_hot] = [T_cold, T_hot].map((T) => own.equilibrium(T));
  if (!(phi_hot > phi_00)) throw new Refusal(`${gel.name} does not collapse between ${printed(T_cold, 6)} and ${printed(T_hot, 6)} K`);
  const volume = gel.molecule_volume ?? given.molecule_volume;
  const [cold, hot] = [T_cold, T_hot].map((T) => (BOLTZMANN * T) / volume);
  const Pi_00 = cold * own.osmoticModulus(phi_00, T_cold);
  const Pi_hot = hot * own.osmoticModulus(phi_hot, T_hot);
  return {
    Pi_00, M: (cold * Math.cbrt(phi_00)) / gel.Omega / Pi_00, Pi_ratio: Pi_hot / Pi_00, Phi_inf: phi_hot / phi_00, phi_00, energyBased: true,
    ownHeat: (T) => (BOLTZMANN / volume) * (own.heat(phi_hot, T) - own.heat(phi_00, T)),
    diffusivity: (Phi) => hot * own.diffusivity(phi_00 * Phi, T_hot), // in k/mu_l
  };
}

function linearGel(Pi_00, M, Pi_ratio, Phi_inf) {
  return { Pi_00, M, Pi_ratio, Phi_inf, energyBased: false, diffusivity: (Phi) => Pi_00 * ((Pi_ratio / Phi_inf) * Phi + ((4 * M) / 3) * Math.cbrt(Phi)) };
}
