// What the three explorers share: controls, numbers, canvases, and play.
const still = matchMedia("(prefers-reduced-motion: reduce)");

class Explorer {
  constructor(id) {
    this.element = document.getElementById(id);
    this.canvases = [];
    this.playButton = this.element.querySelector("[data-play]");
    this.playButton.addEventListener("click", () => (this.playing ? this.pause() : this.play()));
    themeListeners.push(() => this.paint());
  }

  control(name) {
    return this.element.querySelector(`[data-control="${name}"]`);
  }

  // A slider over the indices of `count` values; `text` says a value to people.
  slider(name, count, start, text, changed) {
    const input = this.control(name);
    Object.assign(input, { min: 0, max: count - 1, step: 1, value: start });
    const said = this.element.querySelector(`[data-of="${name}"]`);
    const say = () => {
      said.textContent = text(Number(input.value));
      input.setAttribute("aria-valuetext", text(Number(input.value)));
    };
    input.addEventListener("input", () => {
      this.pause();
      say();
      changed(Number(input.value));
    });
    say();
    return (value) => {
      input.value = value;
      say();
    };
  }

  number(name, text) {
    this.element.querySelector(`[data-number="${name}"]`).textContent = text;
  }

  canvas(name, draw) {
    this.canvases.push(new Canvas(this.element.querySelector(`[data-canvas="${name}"]`), draw));
  }

  paint() {
    for (const each of this.canvases) each.paint();
  }

  // Calls `frame(seconds)` until it returns false.  Without motion, one step at a time, slowly.
  animate(frame) {
    let last;
    const step = (now) => {
      if (!this.playing) return;
      const wait = still.matches ? 600 : 0;
      if (last === undefined) last = now;
      if (now - last >= wait) {
        const passed = Math.min((now - last) / 1000, still.matches ? 1 : 0.1);
        last = now;
        if (frame(passed) === false) {
          this.pause();
          return;
        }
      }
      requestAnimationFrame(step);
    };
    this.playing = true;
    this.playButton.textContent = "Pause";
    this.playButton.setAttribute("aria-label", this.playButton.getAttribute("aria-label").replace("Play", "Pause"));
    requestAnimationFrame(step);
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.playButton.textContent = "Play";
    this.playButton.setAttribute("aria-label", this.playButton.getAttribute("aria-label").replace("Pause", "Play"));
  }
}
