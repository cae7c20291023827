const data = JSON.parse(document.getElementById("data").textContent);
root.classList.add("scripted");
startTheme();
startClaims();
startContents();
new TubeExplorer();
new BeadExplorer();
new GelExplorer();
new Designer();
