// The claims: sorted by a heading, filtered by status and by what is typed.
function startClaims() {
  const table = document.getElementById("claims-table");
  const body = table.tBodies[0];
  const rows = [...body.rows];
  const buttons = [...document.querySelectorAll(".filters button")];
  const search = document.getElementById("claims-search");
  const shown = document.getElementById("claims-shown");
  let status = "";

  function filter() {
    const wanted = search.value.trim().toLowerCase();
    for (const row of rows) {
      const fits = !status || row.dataset.status === status;
      row.hidden = !(fits && row.textContent.toLowerCase().includes(wanted));
    }
    const count = rows.filter((row) => !row.hidden).length;
    shown.textContent = `${count} of ${rows.length} claims shown`;
    for (const button of buttons) button.setAttribute("aria-pressed", String(button.dataset.status === status));
  }

  function choose(wanted) {
    status = wanted;
    filter();
  }

  for (const button of buttons) button.addEventListener("click", () => choose(button.dataset.status));
  search.addEventListener("input", filter);
  for (const link of document.querySelectorAll("[data-filter]")) {
    link.addEventListener("click", () => choose(link.dataset.filter));
  }
  // a link to a claim that is filtered away shows all of them
  addEventListener("hashchange", () => {
    const target = document.getElementById(location.hash.slice(1));
    if (target && target.hidden) {
      search.value = "";
      choose("");
      target.scrollIntoView();
    }
  });

  const value = (row, column) => {
    const cell = row.cells[column];
    const text = cell.dataset.value ?? cell.textContent.trim();
    const number = Number.parseFloat(text);
    return Number.isFinite(number) && /^[-\d.]/.test(text) ? number : text;
  };
  const compare = (a, b) => {
    if (typeof a === "number" && typeof b === "number") return a - b;
    if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
    return a.localeCompare(b, "en", { numeric: true });
  };
  for (const button of table.tHead.querySelectorAll("button")) {
    button.addEventListener("click", () => {
      const heading = button.closest("th");
      const up = heading.getAttribute("aria-sort") !== "ascending";
      for (const other of table.tHead.querySelectorAll("th")) other.setAttribute("aria-sort", "none");
      heading.setAttribute("aria-sort", up ? "ascending" : "descending");
      const column = Number(button.dataset.sort);
      const order = [...rows].sort((a, b) => (up ? 1 : -1) * compare(value(a, column), value(b, column)));
      body.append(...order);
    });
  }
  filter();
}

// Which section is being read.
function startContents() {
  const links = new Map([...document.querySelectorAll(".contents a")].map((link) => [link.hash.slice(1), link]));
  const observer = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) {
        if (!entry.isIntersecting || !links.has(entry.target.id)) continue;
        for (const link of links.values()) link.removeAttribute("aria-current");
        links.get(entry.target.id).setAttribute("aria-current", "true");
      }
    },
    { rootMargin: "-20% 0px -75% 0px" },
  );
  for (const section of document.querySelectorAll("main > section")) observer.observe(section);
}
