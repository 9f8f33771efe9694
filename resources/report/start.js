// Brings the viewers of the page to life.

/** Let numbers of hexes in tables lead to them. */
function linkTables(section, viewer) {
  for (const table of section.querySelectorAll("[data-version]")) {
    for (const cell of table.querySelectorAll("tbody td:first-child")) {
      const button = element("button", cell.textContent);
      button.type = "button";
      button.title = "Show this hex";
      const hex = Number(cell.textContent.replaceAll(",", ""));
      button.addEventListener("click", () => viewer.approach(hex, Number(table.dataset.version)));
      cell.replaceChildren(button);
    }
  }
}

/** Bring a viewer to life as it comes into sight; where that cannot be, its picture stays, and it is said why. */
async function start(root) {
  const [head, blob] = ["head", "bytes"].map((name) => root.querySelector(`script[data-of="${name}"]`).textContent);
  try {
    const viewer = new Viewer(root, new HexMesh(JSON.parse(head), await unpacked(blob)));
    linkTables(root.closest("section"), viewer);
  } catch (error) {
    const said = root.querySelector(".cannot");
    said.textContent = `The mesh cannot be turned here: ${error.message}. The picture shows it as it is.`;
    said.hidden = false;
  }
}

const seen = new IntersectionObserver((entries) => {
  for (const entry of entries.filter((one) => one.isIntersecting)) {
    seen.unobserve(entry.target);
    start(entry.target);
  }
}, { rootMargin: "300px" });
for (const root of document.querySelectorAll(".viewer")) seen.observe(root);
