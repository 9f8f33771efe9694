// Start the viewers of the page.

/** Turn the numbers of hexes in tables into buttons that show the hexes. */
function linkTables(section, viewer) {
  for (const table of section.querySelectorAll("[data-version]")) {
    for (const cell of table.querySelectorAll("tbody td:first-child")) {
      const button = element("button", cell.textContent);
      button.type = "button";
      button.title = "Show this hex";
      const hex = parseInt(cell.textContent.replaceAll(",", ""), 10);
      button.addEventListener("click", () => viewer.approach(hex, Number(table.dataset.version)));
      cell.replaceChildren(button);
    }
  }
}

/** Start a viewer when it becomes visible; if that fails, show its picture and the reason. */
async function start(root) {
  const [head, blob] = ["head", "bytes"].map((name) => root.querySelector(`script[data-of="${name}"]`).textContent);
  try {
    const viewer = new Viewer(root, new HexMesh(JSON.parse(head), await unpacked(blob)));
    linkTables(root.closest("section"), viewer);
  } catch (error) {
    const message = root.querySelector(".cannot");
    message.textContent = `The mesh cannot be rotated here: ${error.message}. A picture is shown instead.`;
    message.hidden = false;
  }
}

const seen = new IntersectionObserver((entries) => {
  for (const entry of entries.filter((candidate) => candidate.isIntersecting)) {
    seen.unobserve(entry.target);
    start(entry.target);
  }
}, { rootMargin: "300px" });
for (const root of document.querySelectorAll(".viewer")) seen.observe(root);
